#pragma once

#include <vector>

#include "world/obstacle_field.h"

namespace mocha {

/// A proved lower bound on the length [m] of every path that has the ends and the signature of
/// `path`, wherever it runs between the obstacles.
///
/// Where the path bends around an obstacle, put a ray from the obstacle's nearest point outwards.
/// If the path crosses the ray, net, then so does every path of its class, as their difference does
/// not wind about the obstacle. So each must go by way of some point of the ray; the worst ray
/// counts.
double least_length_m(const std::vector<Eigen::Vector2d>& path, const ObstacleField<2>& field);

}  // namespace mocha
