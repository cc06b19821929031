#pragma once

#include <Eigen/Core>
#include <vector>

namespace mocha {

/// [m], of the straight lines between the points, in the plane or in space.
template <int D>
double length_of(const std::vector<Eigen::Matrix<double, D, 1>>& path) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length_m += (path[i] - path[i - 1]).norm();
  return length_m;
}

}  // namespace mocha
