#pragma once

#include <mocha_ugv/Heartbeat.h>
#include <mocha_ugv/Settlement.h>
#include <mocha_ugv/Trajectory.h>

#include <string>

#include "fleet/protocol/settling_protocol.h"
#include "stack/commitment_keeping.h"
#include "stack/local_replanning.h"

namespace mocha {

mocha_ugv::Trajectory to_message(const CommittedTrajectory& trajectory, const std::string& frame,
                                 ros::Time stamp);
mocha_ugv::Heartbeat to_message(const Heartbeat& heartbeat, const std::string& frame,
                                ros::Time stamp);

/// Throws std::invalid_argument, saying what is wrong, for messages in another frame than `frame`,
/// that promise nothing (PLANNED), or that no robot can have meant (validate()).
CommittedTrajectory trajectory_from_message(const mocha_ugv::Trajectory& message,
                                            const std::string& frame);
Heartbeat heartbeat_from_message(const mocha_ugv::Heartbeat& message);

/// What became of a proposal, or of the motion in force.
mocha_ugv::Settlement settlement_of(const Settled& settled, const std::string& frame,
                                    ros::Time stamp);

/// The same for the proposer.
Answer answer_from_message(const mocha_ugv::Settlement& settlement);

/// The event in words: what, with which peer, where, when and by how much.
std::string describe(const CommitmentEvent& event);

}  // namespace mocha
