#pragma once

#include <utility>
#include <vector>

#include "topology/space/solid_voxels.h"

namespace mocha {

/// The ways through a map as a graph, in the middle between all obstacles. It holds narrow ways,
/// which samples may miss.
struct Landmarks {
  std::vector<Eigen::Vector3d> places;          ///< widest first; denser where it is narrow
  std::vector<std::pair<int, int>> neighbours;  ///< places between which the ways lead
};

/// Returns the landmarks of what is open in the field's map to what keeps `clearance_m`.
Landmarks landmarks(const SolidVoxels& voxels, const VoxelDistanceField& field, double clearance_m);

}  // namespace mocha
