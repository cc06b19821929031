#pragma once

#include <vector>

#include "trajectory/motion.h"

namespace mocha {

// How two motions become one. All that joins motions goes through here; where the parts do not
// meet, as closely as Motion asks for, the fault says why.

/// `head`, which begins at `start_time_s`, and then `tail` from its own time `tail_from_s` on,
/// shifted in time so that it follows the head.
MotionOrFault splice(double start_time_s, std::vector<Phase> head, const Motion& tail,
                     double tail_from_s);

/// What `first` does from `from_s` (or from the last time before at which it can be cut) until
/// `join_s`, and then what `second` does from there on; each stands before its start and after its
/// end.
MotionOrFault splice(const Motion& first, double from_s, double join_s, const Motion& second);

/// What is left of a motion from `from_s` on, at which it can be cut: a stand where nothing is.
Motion rest_of(const Motion& motion, double from_s);

}  // namespace mocha
