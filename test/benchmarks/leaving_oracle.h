#pragma once

#include "world/world_file.h"

namespace mocha {

/// What a search on the exact body and the exact walls says of a start, without the planner's own
/// search, its map and its margins.
enum class Leavable {
  kYes,      ///< to where it can turn about, driving forward, backward (if it can) and turning
  kNo,       ///< all that it can reach was looked at
  kTouches,  ///< the body is already nearer to a wall than the search keeps (2 mm)
};

/// Of the world's first robot. Throws std::runtime_error where the search grows too large.
Leavable leavable(const World& world);

}  // namespace mocha
