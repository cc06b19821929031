#pragma once

#include <vector>

#include "world/obstacle.h"

namespace mocha {

/// A choice of `candidates`, by number, that are `apart_m` from each other and from `fixed`: those
/// that have the fewest others about them come first, which fills corridors from their ends without
/// gaps.
std::vector<int> packed(const std::vector<Vector2>& candidates, const std::vector<Vector2>& fixed,
                        double apart_m);

/// Moves what was chosen to where there is more `room_m` (of each candidate), each by steps of at
/// most `step_m` between candidates, as far as all stay `apart_m` from each other and from `fixed`.
std::vector<int> settled(std::vector<int> chosen, const std::vector<Vector2>& candidates,
                         const std::vector<double>& room_m, const std::vector<Vector2>& fixed,
                         double apart_m, double step_m);

}  // namespace mocha
