#pragma once

#include <vector>

#include "world/obstacle.h"

namespace mocha {

/// A choice of `candidates`, by number, that are `apart_m` from each other and from `fixed`: those
/// that have the fewest others about them come first, which fills corridors from their ends without
/// gaps.
std::vector<int> packed(const std::vector<Vector2>& candidates, const std::vector<Vector2>& fixed,
                        double apart_m);

}  // namespace mocha
