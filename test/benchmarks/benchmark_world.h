#pragma once

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
  PrimitiveField<D> field;
  std::vector<Point> path;  ///< from start to goal, straight between [m]
};

/// What the worlds are made with.
struct BenchmarkOptions {
  double front_end_clearance_m = 1.5;  ///< of the path
  double gap_m = 3.2;                  ///< between two obstacles at least
};

/// 65 circles of 1 to 4 m radius in 100 m x 100 m, crossed from corner to corner: a path of about
/// 146 m.
BenchmarkWorld<2> circle_world(int seed, const BenchmarkOptions& options);

/// A forest of upright trunks of 0.4 to 1.2 m radius in 122 m x 122 m, crossed from corner to
/// corner while climbing: a path of about 178 m.
BenchmarkWorld<3> forest_world(int seed, const BenchmarkOptions& options);

}  // namespace mocha
