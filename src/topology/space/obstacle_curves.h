#pragma once

#include <vector>

#include "topology/signatures/h_signature.h"
#include "topology/space/solid_voxels.h"

namespace mocha {

/// What a map in space holds, shrunk to curves inside of its solid matter that tell apart on which
/// side it is passed.
struct ObstacleCurves {
  /// Columns from floor to ceiling; loops, such as rings; arches through walls, floor or ceiling,
  /// such as beams and what is between windows. As many as there are independent ways around solid
  /// matter, so that paths with the same signature pass it alike, and (paper IV-E) paths with
  /// different ones cannot be deformed into each other.
  std::vector<Cuts<3>::Curve> curves;
  /// What is no curve: bodies that hang free, which are passed on any side alike, and voxels that
  /// thinning left on surfaces.
  int bodies = 0;
  int surface_voxels = 0;
};

ObstacleCurves obstacle_curves(const SolidVoxels& voxels);

}  // namespace mocha
