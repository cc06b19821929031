#pragma once

#include <vector>

#include "topology/roadmaps/sampled_space.h"

namespace mocha {

/// A shorter path of the same class in a space where lengths are Euclidean: corners are cut
/// wherever the straight line is in order, clear and crosses the same cuts, until little is gained.
/// The path itself, from the earlier to the later where there is an order, must be clear.
template <int D>
std::vector<Eigen::Matrix<double, D, 1>> with_shortcuts(
    std::vector<Eigen::Matrix<double, D, 1>> path, const SampledSpace<D>& space);

extern template std::vector<Eigen::Vector3d> with_shortcuts(std::vector<Eigen::Vector3d>,
                                                            const SampledSpace<3>&);
extern template std::vector<Eigen::Vector4d> with_shortcuts(std::vector<Eigen::Vector4d>,
                                                            const SampledSpace<4>&);

}  // namespace mocha
