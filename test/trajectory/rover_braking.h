#pragma once

#include "trajectory/braking.h"

namespace mocha::test {

/// How a robot of the default model brakes.
inline const Braking kRoverBraking(0.48, 0.8);

}  // namespace mocha::test
