#pragma once

#include <vector>

#include "perception/pose_graph/keyframe.h"
#include "world/occupancy_grid.h"

namespace mocha {

/// What keyframes saw no farther than `reach_m` from `centre` along each axis, in cells of
/// `cell_m`.
OccupancyGrid grid_of(const std::vector<PlacedKeyframe>& keyframes, const Vector2& centre,
                      double reach_m, double cell_m);

/// Returns the beams of a keyframe. Beams that end where the grid of all keyframes is free have met
/// something that moved; their ends are left out.
std::vector<Beam> lasting_beams(const PlacedKeyframe& keyframe, const OccupancyGrid& all);

}  // namespace mocha
