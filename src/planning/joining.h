#pragma once

#include <optional>

#include "trajectory/motion.h"

namespace mocha {

/// Out of `committed`, from `now_s` on, into `plan` at `join_s`, a switch time of the former.
/// Nothing where they do not meet there in place, heading and velocity, as closely as Motion asks
/// for, or the plan is over.
std::optional<Motion> joined(const Motion& committed, const Motion& plan, double now_s,
                             double join_s);

/// A plan from rest that came too late for its own times is as good later, while the robot stands
/// where it begins: the same from `join_s` on. Nothing where it is not so.
std::optional<Motion> postponed(const Motion& committed, const Motion& plan, double join_s);

}  // namespace mocha
