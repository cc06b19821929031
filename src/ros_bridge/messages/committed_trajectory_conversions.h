#pragma once

#include <mocha_ugv/Heartbeat.h>
#include <mocha_ugv/Settlement.h>
#include <mocha_ugv/Trajectory.h>

#include <string>

#include "fleet/protocol/commitment_protocol.h"

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

/// What became of a proposal, by the proposer's own number; of a breach the number is 0.
mocha_ugv::Settlement settlement_of(const CommitmentEvent& event, const std::string& frame,
                                    ros::Time stamp);

/// The event in words: what, with whom, where, when and by how much.
std::string describe(const CommitmentEvent& event);

}  // namespace mocha
