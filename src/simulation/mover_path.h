#pragma once

#include <optional>

#include "world/world_file.h"

namespace mocha {

/// Where a mover is and how fast.
struct MoverState {
  Vector2 centre;
  Vector2 velocity;  ///< [m/s]
};

/// `elapsed_s` after it set out; nothing while it is not in the world.
std::optional<MoverState> mover_state(const Mover& mover, double elapsed_s);

}  // namespace mocha
