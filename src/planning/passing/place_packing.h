#pragma once

#include <vector>

#include "world/obstacle.h"

namespace mocha {

/// A choice of `candidates`, by number, that are `apart_m` from each other and from `fixed`: those
/// that have the fewest others about them come first, which fills corridors from their ends without
/// gaps.
std::vector<int> packed(const std::vector<Vector2>& candidates, const std::vector<Vector2>& fixed,
                        double apart_m);

/// Moves what was chosen to where there is more room, each by steps of at most `step_m` between
/// candidates: to walls, as `room_m` says of each candidate, and beyond `apart_m` to each other and
/// to `fixed`, whichever is less.
std::vector<int> settled(std::vector<int> chosen, const std::vector<Vector2>& candidates,
                         const std::vector<double>& room_m, const std::vector<Vector2>& fixed,
                         double apart_m, double step_m);

}  // namespace mocha
