#pragma once

#include "perception/mapping/voxel_band.h"

namespace mocha {

/// What a band knows, in smaller cells of another band of the same heights, which knows nothing
/// yet. Whatever an occupied voxel covers is occupied; only what known voxels cover wholly is
/// known. The layer of the scans becomes that of the scans alone: scans could not correct the
/// others.
void resample(const VoxelBand& from, VoxelBand& to);

}  // namespace mocha
