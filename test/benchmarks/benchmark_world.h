#pragma once

#include <memory>
#include <random>
#include <vector>

#include "world/primitive_field.h"

namespace mocha {

/// A square from the origin on, and the circles to be strewn over it.
struct Ground {
  double side_m;
  int circles;
  double smallest_m;  ///< radius
  double largest_m;
};

/// Circles at random, farther than `gap_m` from each other and from the points that are to stay
/// free. Throws std::runtime_error if they do not fit.
std::vector<Circle> scatter(const Ground& ground, double gap_m, const std::vector<Vector2>& free,
                            std::mt19937& random);

/// A seeded world of Table I and a front-end path through it.
template <int D>
struct BenchmarkWorld {
  using Point = Eigen::Matrix<double, D, 1>;
  std::shared_ptr<const ObstacleField<D>> field;
  std::vector<Point> path;  ///< from start to goal, straight between [m]
};

/// What the worlds are made with.
struct BenchmarkOptions {
  Ground ground;
  double gap_m;                  ///< between two obstacles at least
  double front_end_clearance_m;  ///< of the path
};

/// Paths of about 146 m in the plane and 178 m in space that keep clear of everything, ...
inline constexpr BenchmarkOptions kCircles{{100.0, 65, 1.0, 4.0}, 3.2, 1.5};
inline constexpr BenchmarkOptions kForest{{122.0, 150, 0.4, 1.2}, 3.2, 1.5};
/// ... and others as long with four times as many obstacles, and gaps that no path passes with
/// more than 1 m to both sides.
inline constexpr BenchmarkOptions kDenseCircles{{100.0, 250, 0.5, 2.0}, 2.0, 0.8};
inline constexpr BenchmarkOptions kDenseForest{{122.0, 600, 0.3, 1.0}, 2.0, 0.8};

/// Circles, crossed from corner to corner.
BenchmarkWorld<2> circle_world(int seed, const BenchmarkOptions& options);

/// A forest of upright trunks, crossed from corner to corner while climbing, by the shortest path
/// of a roadmap in space.
BenchmarkWorld<3> forest_world(int seed, const BenchmarkOptions& options);

}  // namespace mocha
