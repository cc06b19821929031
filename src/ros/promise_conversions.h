#pragma once

#include <mocha_ugv/Heartbeat.h>
#include <mocha_ugv/PlannerStatus.h>
#include <mocha_ugv/Trajectory.h>

#include <string>

#include "fleet/commitment.h"

namespace mocha {

mocha_ugv::Trajectory to_message(const Promise& promise, const std::string& frame, ros::Time stamp);
mocha_ugv::Heartbeat to_message(const Beat& beat, const std::string& frame, ros::Time stamp);

/// Throws std::invalid_argument, saying what is wrong, for messages in another frame than `frame`,
/// that promise nothing (PLANNED), or that no robot can have meant (validate()).
Promise promise_from_message(const mocha_ugv::Trajectory& message, const std::string& frame);
Beat beat_from_message(const mocha_ugv::Heartbeat& message);

/// What became of a proposal. The message begins with "proposal N: ", N being the proposer's own
/// number.
mocha_ugv::PlannerStatus settlement_of(const CommitmentEvent& event, const std::string& frame,
                                       ros::Time stamp);

/// The event in words: what, with whom, where, when and by how much.
std::string describe(const CommitmentEvent& event);

}  // namespace mocha
