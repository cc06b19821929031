#pragma once

#include <vector>

#include "world/primitive_field.h"

namespace mocha {

/// A seeded world of Table I and a front-end path through it.
template <int D>
struct BenchmarkWorld {
  using Point = Eigen::Matrix<double, D, 1>;
  PrimitiveField<D> field;
  std::vector<Point> path;  ///< from start to goal, straight between [m]
};

/// What the worlds are made with.
struct BenchmarkRules {
  double front_end_clearance_m = 1.5;  ///< of the path
  double gap_m = 3.2;                  ///< between two obstacles at least
};

/// 65 circles of 1 to 4 m radius in 100 m x 100 m, crossed from corner to corner: a path of about
/// 146 m.
BenchmarkWorld<2> circle_world(int seed, const BenchmarkRules& rules);

/// A forest of upright trunks of 0.4 to 1.2 m radius in 122 m x 122 m, crossed from corner to
/// corner while climbing: a path of about 178 m.
BenchmarkWorld<3> forest_world(int seed, const BenchmarkRules& rules);

}  // namespace mocha
