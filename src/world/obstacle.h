#pragma once

#include <limits>
#include <variant>
#include <vector>

#include "world/footprint.h"

namespace mocha {

/// Shapes in the plane, all of them solid. Map frame, metres.
struct Circle {
  Vector2 centre = Vector2::Zero();
  double radius_m = 0.0;
};

/// A simple polygon, its corners in either sense; the last side runs from the last corner to the
/// first.
struct Polygon {
  std::vector<Vector2> corners;
};

using Obstacle = std::variant<Circle, Polygon>;

/// An upright solid cylinder in space; without a height it is a column from minus to plus infinity.
struct Cylinder {
  Vector2 centre = Vector2::Zero();
  double radius_m = 0.0;
  double from_z_m = -std::numeric_limits<double>::infinity();
  double to_z_m = std::numeric_limits<double>::infinity();
};

/// Why a polygon is not a simple one (too few corners, a corner that is repeated or not finite,
/// sides that meet, no area); empty for a sound one.
std::string fault_of(const Polygon& polygon);

/// Its area, positive for corners in counter-clockwise order.
double signed_area_m2(const Polygon& polygon);

/// The point nearest to p on the line segment from a to b.
Vector2 nearest_on_segment(const Vector2& p, const Vector2& a, const Vector2& b);

/// A distance between surfaces, negative where the shapes overlap, and where it was found.
struct Gap {
  double distance_m;
  Vector2 place;
};

/// From `point` to the nearest point of the shape's rim (`place`); negative inside.
Gap gap(const Vector2& point, const Circle& circle);
Gap gap(const Vector2& point, const Polygon& polygon);

/// The outward unit normal of the polygon's side nearest to `point`.
Vector2 outward_normal(const Vector2& point, const Polygon& polygon);

/// Between two shapes; `place` is on or in the second one. Apart, the distance is exact. Of
/// overlapping polygons it is minus the depth of the deepest corner of either in the other, or of
/// the middle of the overlap where no corner is inside.
Gap gap(const Obstacle& first, const Obstacle& second);

/// How far a ray runs from `origin` along the unit vector `direction` until it meets the shape's
/// rim; infinity if it does not. From inside it meets the rim from behind.
double ray_length(const Vector2& origin, const Vector2& direction, const Circle& circle);
double ray_length(const Vector2& origin, const Vector2& direction, const Polygon& polygon);
/// Likewise for the line segment from a to b.
double ray_length(const Vector2& origin, const Vector2& direction, const Vector2& a,
                  const Vector2& b);

/// The true shape of a robot at `pose`.
Obstacle placed(const Footprint& footprint, const Pose& pose);

}  // namespace mocha
