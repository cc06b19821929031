#include "world/primitive.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace mocha {
namespace {

using Box2 = Eigen::AlignedBox2d;
using Box3 = Eigen::AlignedBox3d;
using Sample2 = ObstacleField<2>::Sample;
using Sample3 = ObstacleField<3>::Sample;

constexpr double kFarthest_m = 1e12;  // keeps squares and grids of them far from overflow
constexpr double kOnRim_m = 1e-9;     // nearer, the way to the rim is rounding noise

void require(bool condition, const char* name, double value, const char* range) {
  if (condition) return;
  std::ostringstream message;
  message << "primitive: " << name << " = " << value << ": expected " << range;
  throw std::invalid_argument(message.str());
}

void check_coordinates(const Vector2& p) {
  for (const double value : p) {
    require(std::abs(value) <= kFarthest_m, "coordinate", value, "a number within +-1e12 m");
  }
}

void check_disc(const Vector2& centre, double radius_m) {
  check_coordinates(centre);
  require(radius_m >= 0.0 && radius_m <= kFarthest_m, "radius_m", radius_m, "0 to 1e12");
}

/// Away from the centre; any direction will do in the centre itself.
Vector2 radial(const Vector2& away, double distance) {
  return distance > 0.0 ? Vector2(away / distance) : Vector2(1.0, 0.0);
}

Sample2 sample_of(const Circle& circle, const Vector2& p) {
  const Vector2 away = p - circle.centre;
  const double distance = away.norm();
  return {distance - circle.radius_m, radial(away, distance)};
}

Sample2 sample_of(const Polygon& polygon, const Vector2& p) {
  const Gap to_rim = gap(p, polygon);
  if (std::abs(to_rim.distance_m) < kOnRim_m) {
    return {to_rim.distance_m, outward_normal(p, polygon)};
  }
  return {to_rim.distance_m, (p - to_rim.place) / to_rim.distance_m};
}

/// Whether the segment from a to b enters the box (Liang and Barsky 1984).
bool enters(const Box2& box, const Vector2& a, const Vector2& b) {
  double from = 0.0;
  double to = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double along = b[axis] - a[axis];
    const double low = box.min()[axis] - a[axis];
    const double high = box.max()[axis] - a[axis];
    if (along == 0.0) {
      if (low > 0.0 || high < 0.0) return false;
      continue;
    }
    from = std::max(from, std::min(low / along, high / along));
    to = std::min(to, std::max(low / along, high / along));
  }
  return from <= to;
}

double box_distance(const Circle& circle, const Box2& box) {
  return box.exteriorDistance(circle.centre) - circle.radius_m;
}

double box_distance(const Polygon& polygon, const Box2& box) {
  if (gap(Vector2(box.center()), polygon).distance_m <= 0.0) return 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
    const Vector2& a = polygon.corners[i];
    const Vector2& b = polygon.corners[(i + 1) % polygon.corners.size()];
    if (enters(box, a, b)) return 0.0;
    nearest = std::min(nearest, box.exteriorDistance(a));
    for (const auto where : {Box2::BottomLeft, Box2::BottomRight, Box2::TopLeft, Box2::TopRight}) {
      const Vector2 corner = box.corner(where);
      nearest = std::min(nearest, (corner - nearest_on_segment(corner, a, b)).norm());
    }
  }
  return nearest;
}

Box2 square(const Vector2& centre, double radius_m) {
  const Vector2 half = Vector2::Constant(radius_m);
  return {Vector2(centre - half), Vector2(centre + half)};
}

}  // namespace

void check(const Obstacle& obstacle) {
  if (const auto* circle = std::get_if<Circle>(&obstacle)) {
    return check_disc(circle->centre, circle->radius_m);
  }
  const auto& polygon = std::get<Polygon>(obstacle);
  for (const Vector2& corner : polygon.corners) check_coordinates(corner);
  const std::string fault = fault_of(polygon);
  if (!fault.empty()) throw std::invalid_argument("primitive: polygon: " + fault);
}

void check(const Cylinder& cylinder) {
  check_disc(cylinder.centre, cylinder.radius_m);
  require(cylinder.from_z_m <= kFarthest_m, "from_z_m", cylinder.from_z_m, "at most 1e12");
  require(cylinder.to_z_m >= std::max(cylinder.from_z_m, -kFarthest_m), "to_z_m", cylinder.to_z_m,
          "at least from_z_m and -1e12");
}

Sample2 sample(const Obstacle& obstacle, const Eigen::Vector2d& p) {
  if (const auto* circle = std::get_if<Circle>(&obstacle)) return sample_of(*circle, p);
  return sample_of(std::get<Polygon>(obstacle), p);
}

double distance_m(const Obstacle& obstacle, const Eigen::Vector2d& p) {
  const auto* circle = std::get_if<Circle>(&obstacle);
  return circle ? (p - circle->centre).norm() - circle->radius_m
                : gap(p, std::get<Polygon>(obstacle)).distance_m;
}

double distance_m(const Cylinder& cylinder, const Eigen::Vector3d& p) {
  return sample(cylinder, p).distance_m;
}

Sample3 sample(const Cylinder& cylinder, const Eigen::Vector3d& p) {
  const Vector2 away = p.head<2>() - cylinder.centre;
  const double from_axis = away.norm();
  const Vector2 outwards = radial(away, from_axis);
  const double beside = from_axis - cylinder.radius_m;
  const double below = cylinder.from_z_m - p.z();
  const double above = p.z() - cylinder.to_z_m;
  const double beyond = std::max(below, above);
  const double upwards = above > below ? 1.0 : -1.0;
  if (beside > 0.0 && beyond > 0.0) {  // off the edge of an end
    const double distance = std::hypot(beside, beyond);
    const Vector2 across = beside / distance * outwards;
    return {distance, {across.x(), across.y(), beyond / distance * upwards}};
  }
  if (beside > beyond) return {beside, {outwards.x(), outwards.y(), 0.0}};
  return {beyond, {0.0, 0.0, upwards}};
}

double distance_m(const Obstacle& obstacle, const Box2& box) {
  if (const auto* circle = std::get_if<Circle>(&obstacle)) return box_distance(*circle, box);
  return box_distance(std::get<Polygon>(obstacle), box);
}

double distance_m(const Cylinder& cylinder, const Box3& box) {
  const Box2 floor(box.min().head<2>(), box.max().head<2>());
  const double beside = box_distance(Circle{cylinder.centre, cylinder.radius_m}, floor);
  const double beyond =
      std::max(cylinder.from_z_m - box.max().z(), box.min().z() - cylinder.to_z_m);
  if (beside > 0.0 && beyond > 0.0) return std::hypot(beside, beyond);
  return std::max(beside, beyond);
}

Box2 extent(const Obstacle& obstacle) {
  if (const auto* circle = std::get_if<Circle>(&obstacle)) {
    return square(circle->centre, circle->radius_m);
  }
  Box2 box;
  for (const Vector2& corner : std::get<Polygon>(obstacle).corners) box.extend(corner);
  return box;
}

Box2 extent(const Cylinder& cylinder) { return square(cylinder.centre, cylinder.radius_m); }

}  // namespace mocha
