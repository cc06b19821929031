#pragma once

#include <optional>

#include "world/obstacle.h"

namespace mocha {

/// A place to be reached, with a heading where one is asked for. Map frame.
struct Goal {
  Vector2 position;
  std::optional<double> yaw_rad;
};

}  // namespace mocha
