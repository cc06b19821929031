#include "world/footprint.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "world/obstacle.h"

namespace mocha {

Footprint Footprint::disc(double radius_m) {
  if (!(radius_m > 0.0)) throw std::invalid_argument("Footprint: the radius is not positive");
  Footprint footprint;
  footprint.soft_cover_ = {{Vector2::Zero(), radius_m}};
  footprint.cover_ = DiscTree(footprint.soft_cover_, radius_m);
  footprint.circumscribed_radius_m_ = radius_m;
  footprint.inscribed_radius_m_ = radius_m;
  return footprint;
}

Footprint Footprint::rectangle(double length_m, double width_m) {
  if (!(length_m > 0.0) || !(width_m > 0.0))
    throw std::invalid_argument("Footprint: length or width is not positive");
  const double x = 0.5 * length_m;
  const double y = 0.5 * width_m;
  return polygon({{x, y}, {-x, y}, {-x, -y}, {x, -y}});
}

Footprint Footprint::polygon(std::vector<Vector2> corners) {
  Polygon body{std::move(corners)};
  const std::string fault = fault_of(body);
  if (!fault.empty()) throw std::invalid_argument("Footprint: " + fault);
  const double outside_m = gap(Vector2::Zero(), body).distance_m;
  if (!(outside_m < 0.0))
    throw std::invalid_argument("Footprint: base_link, (0, 0), is not inside the polygon");
  if (signed_area_m2(body) < 0.0) std::reverse(body.corners.begin(), body.corners.end());
  Footprint footprint;
  footprint.corners_ = std::move(body.corners);
  footprint.inscribed_radius_m_ = -outside_m;
  for (const Vector2& corner : footprint.corners_)
    footprint.circumscribed_radius_m_ = std::max(footprint.circumscribed_radius_m_, corner.norm());
  footprint.cover_ =
      DiscTree(disc_cover(footprint.corners_, kCoverTolerance_m), footprint.cover_reach_m());
  footprint.soft_cover_ = soft_disc_cover(footprint.corners_, kSoftCoverTolerance_m);
  return footprint;
}

double Footprint::depth_m(const Vector2& in_body) const {
  if (is_disc()) return circumscribed_radius_m_ - in_body.norm();
  return -gap(in_body, Polygon{corners_}).distance_m;
}

double Footprint::cover_reach_m() const {
  return circumscribed_radius_m_ + (is_disc() ? 0.0 : kCoverTolerance_m);
}

Vector2 cover_centre(const Pose& pose, const CoverDisc& disc) {
  return pose.position + turned(disc.offset_m, {std::cos(pose.yaw_rad), std::sin(pose.yaw_rad)});
}

}  // namespace mocha
