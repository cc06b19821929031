#pragma once

#include <cstddef>
#include <vector>

#include "trajectory/motion.h"

namespace mocha {

/// The same path with at most `most` >= 2 of its places, as near to it as these allow (Douglas and
/// Peucker).
std::vector<Vector2> few_places(const std::vector<Vector2>& path, std::size_t most);

}  // namespace mocha
