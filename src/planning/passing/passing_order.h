#pragma once

#include <vector>

#include "fleet/protocol/passing_messages.h"
#include "planning/passing/joint_step.h"

namespace mocha {

/// The moves of each robot, and which of them have to wait for which of others. Whoever keeps to it
/// needs no common time: in whatever order the moves are made one by one, each finds its way free,
/// and there is always a next one until all are at their goals.
using PassingOrder = std::vector<std::vector<PassingTurn>>;

PassingOrder order_of(const std::vector<JointStep>& steps, int robots);

/// Returns for each robot the number of its first move from which on none of its moves waits for
/// another robot, and no other robot for them.
std::vector<std::uint32_t> alone_from(const PassingOrder& order);

}  // namespace mocha
