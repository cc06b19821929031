#include "world/obstacle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trajectory/plane_vectors.h"

namespace mocha {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr double kSmallestSide_m = 1e-6;

const Vector2& corner(const Polygon& polygon, std::size_t i) {
  return polygon.corners[i % polygon.corners.size()];
}

/// Whether the segments a-b and c-d share a point; where, for those that are not parallel.
bool segments_meet(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& d,
                   Vector2& where) {
  const double turn = cross(b - a, d - c);
  if (turn == 0.0) return false;
  const double along_first = cross(c - a, d - c) / turn;
  const double along_second = cross(c - a, b - a) / turn;
  where = a + along_first * (b - a);
  return along_first >= 0.0 && along_first <= 1.0 && along_second >= 0.0 && along_second <= 1.0;
}

bool sides_cross(const Polygon& polygon) {
  const std::size_t count = polygon.corners.size();
  Vector2 where;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 2; j < count; ++j) {
      if (i == 0 && j == count - 1) continue;  // neighbours share their corner
      if (segments_meet(corner(polygon, i), corner(polygon, i + 1), corner(polygon, j),
                        corner(polygon, j + 1), where)) {
        return true;
      }
    }
  }
  return false;
}

/// The middle of where the rims of two polygons meet; false where they do not.
bool middle_of_crossings(const Polygon& first, const Polygon& second, Vector2& middle) {
  int crossings = 0;
  Vector2 sum = Vector2::Zero();
  Vector2 where;
  for (std::size_t i = 0; i < first.corners.size(); ++i) {
    for (std::size_t j = 0; j < second.corners.size(); ++j) {
      if (!segments_meet(corner(first, i), corner(first, i + 1), corner(second, j),
                         corner(second, j + 1), where)) {
        continue;
      }
      sum += where;
      ++crossings;
    }
  }
  if (crossings > 0) middle = sum / crossings;
  return crossings > 0;
}

Gap between(const Circle& first, const Circle& second) {
  Gap result = gap(first.centre, second);
  result.distance_m -= first.radius_m;
  return result;
}

Gap between(const Circle& first, const Polygon& second) {
  Gap result = gap(first.centre, second);
  result.distance_m -= first.radius_m;
  return result;
}

Gap between(const Polygon& first, const Circle& second) {
  const Gap from_centre = gap(second.centre, first);
  const Vector2 away = from_centre.place - second.centre;
  const double distance = away.norm();
  const double reach = std::min(distance, second.radius_m);
  const Vector2 place = second.centre + (distance > 0.0 ? Vector2(reach / distance * away) : away);
  return {from_centre.distance_m - second.radius_m, place};
}

Gap between(const Polygon& first, const Polygon& second) {
  Gap nearest{kEndless, Vector2::Zero()};
  for (const Vector2& point : first.corners) {
    const Gap here = gap(point, second);
    if (here.distance_m < nearest.distance_m) nearest = here;
  }
  for (const Vector2& point : second.corners) {
    const double distance = gap(point, first).distance_m;
    if (distance < nearest.distance_m) nearest = {distance, point};
  }
  Vector2 middle;
  if (nearest.distance_m > 0.0 && middle_of_crossings(first, second, middle)) {
    const double depth = std::min(-gap(middle, first).distance_m, -gap(middle, second).distance_m);
    return {-std::max(depth, kSmallestSide_m), middle};
  }
  return nearest;
}

}  // namespace

std::string fault_of(const Polygon& polygon) {
  if (polygon.corners.size() < 3) return "a polygon needs at least 3 corners";
  for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
    if (!corner(polygon, i).allFinite()) return "a corner is not finite";
    if ((corner(polygon, i + 1) - corner(polygon, i)).norm() < kSmallestSide_m) {
      return "a corner is repeated";
    }
  }
  if (sides_cross(polygon)) return "sides cross each other";
  if (std::abs(signed_area_m2(polygon)) < kSmallestSide_m * kSmallestSide_m) return "has no area";
  return {};
}

double signed_area_m2(const Polygon& polygon) {
  double doubled_m2 = 0.0;
  for (std::size_t i = 0; i < polygon.corners.size(); ++i)
    doubled_m2 += cross(corner(polygon, i), corner(polygon, i + 1));
  return 0.5 * doubled_m2;
}

Vector2 nearest_on_segment(const Vector2& p, const Vector2& a, const Vector2& b) {
  const Vector2 along = b - a;
  const double share = along.dot(p - a) / std::max(along.squaredNorm(), 1e-300);
  return a + std::clamp(share, 0.0, 1.0) * along;
}

Gap gap(const Vector2& point, const Circle& circle) {
  const Vector2 away = point - circle.centre;
  const double distance = away.norm();
  const Vector2 normal = distance > 0.0 ? Vector2(away / distance) : Vector2(1.0, 0.0);
  return {distance - circle.radius_m, circle.centre + circle.radius_m * normal};
}

Gap gap(const Vector2& point, const Polygon& polygon) {
  double nearest_squared = kEndless;
  Vector2 nearest = point;
  bool inside = false;
  const Vector2* a = &polygon.corners.back();
  for (const Vector2& b : polygon.corners) {
    const Vector2 place = nearest_on_segment(point, *a, b);
    const double squared = (point - place).squaredNorm();
    if (squared < nearest_squared) {
      nearest_squared = squared;
      nearest = place;
    }
    const bool spans = (a->y() > point.y()) != (b.y() > point.y());
    if (spans && (cross(b - *a, point - *a) > 0.0) == (b.y() > a->y())) inside = !inside;
    a = &b;
  }
  const double distance = std::sqrt(nearest_squared);
  return {inside ? -distance : distance, nearest};
}

Vector2 outward_normal(const Vector2& point, const Polygon& polygon) {
  double nearest = kEndless;
  Vector2 side = Vector2::Zero();
  for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
    const Vector2& a = corner(polygon, i);
    const Vector2& b = corner(polygon, i + 1);
    const double distance = (point - nearest_on_segment(point, a, b)).norm();
    if (distance >= nearest) continue;
    nearest = distance;
    side = b - a;
  }
  const double sense = signed_area_m2(polygon) > 0.0 ? 1.0 : -1.0;
  return sense * Vector2(side.y(), -side.x()).normalized();
}

Gap gap(const Obstacle& first, const Obstacle& second) {
  return std::visit([](const auto& a, const auto& b) { return between(a, b); }, first, second);
}

double ray_length(const Vector2& origin, const Vector2& direction, const Circle& circle) {
  const Vector2 to_centre = circle.centre - origin;
  const double along = to_centre.dot(direction);
  const double across = cross(direction, to_centre);
  const double half_chord_squared = circle.radius_m * circle.radius_m - across * across;
  if (half_chord_squared < 0.0) return kEndless;
  const double half_chord = std::sqrt(half_chord_squared);
  if (along - half_chord >= 0.0) return along - half_chord;
  return along + half_chord >= 0.0 ? along + half_chord : kEndless;
}

double ray_length(const Vector2& origin, const Vector2& direction, const Vector2& a,
                  const Vector2& b) {
  const Vector2 side = b - a;
  const double turn = cross(direction, side);
  if (turn == 0.0) return kEndless;
  const double length = cross(a - origin, side) / turn;
  const double share = cross(a - origin, direction) / turn;
  return length >= 0.0 && share >= 0.0 && share <= 1.0 ? length : kEndless;
}

double ray_length(const Vector2& origin, const Vector2& direction, const Polygon& polygon) {
  double length = kEndless;
  for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
    length =
        std::min(length, ray_length(origin, direction, corner(polygon, i), corner(polygon, i + 1)));
  }
  return length;
}

Obstacle placed(const Footprint& footprint, const Pose& pose) {
  if (footprint.is_disc()) return Circle{pose.position, footprint.circumscribed_radius_m()};
  const double c = std::cos(pose.yaw_rad);
  const double s = std::sin(pose.yaw_rad);
  Polygon polygon;
  for (const Vector2& p : footprint.corners()) {
    polygon.corners.emplace_back(pose.position +
                                 Vector2(c * p.x() - s * p.y(), s * p.x() + c * p.y()));
  }
  return polygon;
}

}  // namespace mocha
