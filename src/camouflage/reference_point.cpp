#include "camouflage/reference_point.h"

#include <algorithm>
#include <cmath>

namespace mocha {
namespace {

using Point = Eigen::Vector2d;

constexpr double kLeastLeverage_m = 1e-3;  // between a reference and its knots

Point left_of(const Point& direction) { return {-direction.y(), direction.x()}; }

/// Free room beside the stretch, summed: the sparser side has more. `side` is +1 left, -1 right.
double room_beside(const PlanarPoints& path, int from, int to, double side,
                   const ObstacleField<2>& field, double depth_m) {
  double room = 0.0;
  for (int k = from; k < to; ++k) {
    const Point along = (path.col(k + 1) - path.col(k)).normalized();
    const Point middle = 0.5 * (path.col(k) + path.col(k + 1));
    for (const double share : {0.5, 1.0}) {
      const Point beside = middle + side * share * depth_m * left_of(along);
      room += std::clamp(field.sample(beside).distance_m, 0.0, depth_m);
    }
  }
  return room;
}

Point apex(const PlanarPoints& path, int from, int to, double side, double height) {
  const Point chord = path.col(to) - path.col(from);
  return path.col(from) + 0.5 * chord + side * 0.5 * height * left_of(chord);
}

/// Do the rays to the knots strictly between from and to keep the angle to the path on both sides
/// of the knot?
bool keeps_angle(const PlanarPoints& path, int from, int to, const Point& reference,
                 double min_sine) {
  for (int k = from + 1; k < to; ++k) {
    const Point ray = path.col(k) - reference;
    for (const Point& along :
         {Point(path.col(k) - path.col(k - 1)), Point(path.col(k + 1) - path.col(k))}) {
      const double cross = std::abs(ray.x() * along.y() - ray.y() * along.x());
      // Written so that a vanishing ray or step fails, too.
      if (!(ray.norm() > kLeastLeverage_m && cross > min_sine * ray.norm() * along.norm()))
        return false;
    }
  }
  return true;
}

std::optional<Point> reference_for(const PlanarPoints& path, int from, int to,
                                   const ObstacleField<2>& field, const ReferenceRules& rules) {
  const double left = room_beside(path, from, to, 1.0, field, rules.side_depth_m);
  const double right = room_beside(path, from, to, -1.0, field, rules.side_depth_m);
  const double preferred = left >= right ? 1.0 : -1.0;
  for (const double side : {preferred, -preferred}) {
    const Point reference = apex(path, from, to, side, rules.apex_height);
    if (keeps_angle(path, from, to, reference, std::sin(rules.min_angle_rad))) return reference;
  }
  return std::nullopt;
}

}  // namespace

std::optional<PlanarPoints> choose_references(const PlanarPoints& path,
                                              const ObstacleField<2>& field,
                                              const ReferenceRules& rules) {
  const int last = static_cast<int>(path.cols()) - 1;
  PlanarPoints references(2, std::max(0, last - 1));
  for (int from = 0; from + 1 < last;) {
    int to = last;
    std::optional<Point> reference;
    // Stretches overlap by one step, so that every interior knot lies strictly inside one of them.
    for (; to >= from + 2 && !reference; --to)
      reference = reference_for(path, from, to, field, rules);
    if (!reference) return std::nullopt;
    ++to;
    for (int k = from + 1; k < to; ++k) references.col(k - 1) = *reference;
    from = to - 1;
  }
  return references;
}

}  // namespace mocha
