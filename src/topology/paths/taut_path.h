#pragma once

#include <vector>

#include "topology/roadmaps/sampled_space.h"

namespace mocha {

/// The same path in space with its corners pulled towards the straight lines between their
/// neighbours, along all axes together and along each alone, as far as what is around and the class
/// allow: a path around pillars does not go up and down as well. The path itself must be clear.
std::vector<Eigen::Vector3d> pulled_taut(std::vector<Eigen::Vector3d> path,
                                         const SampledSpace<3>& space);

}  // namespace mocha
