#include "world/footprint.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mocha {

Footprint Footprint::disc(double radius_m) {
  if (!(radius_m > 0.0)) throw std::invalid_argument("Footprint: the radius is not positive");
  Footprint footprint;
  footprint.cover_ = {{0.0, radius_m}};
  footprint.circumscribed_radius_m_ = radius_m;
  return footprint;
}

Footprint Footprint::rectangle(double length_m, double width_m, int discs) {
  if (!(length_m > 0.0) || !(width_m > 0.0) || discs < 1) {
    throw std::invalid_argument("Footprint: length, width or number of discs is not positive");
  }
  Footprint footprint;
  const double part = length_m / discs;
  const double radius = std::hypot(0.5 * part, 0.5 * width_m);
  for (int i = 0; i < discs; ++i) {
    footprint.cover_.push_back({(i - 0.5 * (discs - 1)) * part, radius});
  }
  const double x = 0.5 * length_m;
  const double y = 0.5 * width_m;
  footprint.corners_ = {{x, y}, {-x, y}, {-x, -y}, {x, -y}};
  footprint.circumscribed_radius_m_ = std::hypot(x, y);
  return footprint;
}

Vector2 cover_centre(const Pose& pose, const Footprint::CoverDisc& disc) {
  return pose.position + disc.offset_m * Vector2(std::cos(pose.yaw_rad), std::sin(pose.yaw_rad));
}

double Footprint::cover_reach_m() const {
  double reach_m = 0.0;
  for (const CoverDisc& disc : cover_)
    reach_m = std::max(reach_m, std::abs(disc.offset_m) + disc.radius_m);
  return reach_m;
}

}  // namespace mocha
