#pragma once

#include <vector>

#include "camouflage/adaptive_map.h"

namespace mocha {

/// The knots of a curve in order, and how long the pieces between them last.
template <int D>
struct KnotChain {
  std::vector<RayKnot<D>> knots;
  Eigen::VectorXd durations_s;  ///< one more than knots

  int pieces() const { return static_cast<int>(durations_s.size()); }
};

}  // namespace mocha
