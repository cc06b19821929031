#pragma once

#include "world/obstacle.h"
#include "world/obstacle_field.h"

namespace mocha {

// What a field asks of one of its shapes. Map frame, metres.

/// Throws std::invalid_argument, saying what is wrong, for a negative radius, for values that are
/// not numbers or farther out than 1e12 m, for polygons with a fault and for cylinders that end
/// below their start.
void check(const Obstacle& obstacle);
void check(const Cylinder& cylinder);

/// The signed distance of the surface from p, exact, and its gradient: a unit vector, also where
/// several would do (in a centre, on an axis, on a rim).
ObstacleField<2>::Sample sample(const Obstacle& obstacle, const Eigen::Vector2d& p);
ObstacleField<3>::Sample sample(const Cylinder& cylinder, const Eigen::Vector3d& p);

/// The distance alone.
double distance_m(const Obstacle& obstacle, const Eigen::Vector2d& p);
double distance_m(const Cylinder& cylinder, const Eigen::Vector3d& p);

/// How far the shape is from the nearest point of a box, exact; 0 or less where they overlap.
double distance_m(const Obstacle& obstacle, const Eigen::AlignedBox2d& box);
double distance_m(const Cylinder& cylinder, const Eigen::AlignedBox3d& box);

/// The smallest rectangle over x and y that holds the shape.
Eigen::AlignedBox2d extent(const Obstacle& obstacle);
Eigen::AlignedBox2d extent(const Cylinder& cylinder);

}  // namespace mocha
