#pragma once

#include <utility>
#include <vector>

#include "topology/space/solid_voxels.h"

namespace mocha {

/// The ways through a map, in the middle between all obstacles, as a graph: it holds every way
/// through what is open, however narrow, which samples may miss.
struct Landmarks {
  std::vector<Eigen::Vector3d> places;          ///< widest first; denser where it is narrow
  std::vector<std::pair<int, int>> neighbours;  ///< places with nothing but room between them
};

/// For whoever keeps `clearance_m` to obstacles.
Landmarks landmarks(const SolidVoxels& voxels, double clearance_m);

}  // namespace mocha
