#pragma once

#include "world/moving/moving_obstacle.h"
#include "world/moving/tube.h"

namespace mocha {

/// A tube in which the obstacle's disc, its radius enlarged by `keep_m`, is at all times from
/// `from_s` to `until_s`: one piece for constant velocity, else as many as it takes for the discs
/// to be larger than that by at most 3 cm. (By more only where a motion's phases jump so often
/// within 20 ms. The pieces are sound in any case: each is enlarged by
/// MovingObstacle::chord_error_m.) Empty unless from_s < until_s; both finite.
Tube<2> tube_of(const MovingObstacle& obstacle, double from_s, double until_s, double keep_m);

}  // namespace mocha
