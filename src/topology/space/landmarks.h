#pragma once

#include <utility>
#include <vector>

#include "topology/space/solid_voxels.h"

namespace mocha {

/// The ways through a map as a graph, in the middle between all obstacles. It holds narrow ways,
/// which samples may miss, if the centres of their voxels keep the clearance.
struct Landmarks {
  std::vector<Eigen::Vector3d> places;          ///< widest first; denser where it is narrow
  std::vector<std::pair<int, int>> neighbours;  ///< places with nothing but room between them
};

/// Returns the landmarks of what is open. Neighbours keep about `clearance_m` to obstacles.
Landmarks landmarks(const SolidVoxels& voxels, double clearance_m);

}  // namespace mocha
