#pragma once

#include <vector>

#include "perception/mapping/beam_raster.h"

namespace mocha {

/// Cuts a beam to the part between two heights; false if there is none. A beam that goes on meets
/// nothing in there.
bool clip_height(GridBeam& beam, double low, double high);

/// The voxels that hold all beams, of which there is at least one.
VoxelBox box_of(const std::vector<GridBeam>& beams);

}  // namespace mocha
