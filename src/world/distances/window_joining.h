#pragma once

#include <vector>

#include "world/corner_window.h"

namespace mocha {

/// Fewer windows that hold the same: two become one where that, with a margin around it, is no
/// larger than both with theirs.
std::vector<CornerWindow> joined(std::vector<CornerWindow> windows, int margin);

}  // namespace mocha
