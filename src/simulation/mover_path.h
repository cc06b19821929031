#pragma once

#include "world/world_file.h"

namespace mocha {

/// Where a mover is and how fast, `elapsed_s` after it set out. Before, and after the end of a path
/// that does not loop, it stands.
struct MoverState {
  Vector2 centre;
  Vector2 velocity;  ///< [m/s]
};

MoverState mover_state(const Mover& mover, double elapsed_s);

}  // namespace mocha
