#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "config/parameter_table.h"
#include "fleet/protocol/reach.h"
#include "world/robot_model.h"

namespace mocha {

/// How far the clocks of a fleet may be apart.
struct ClockOptions {
  double tolerance_s;  ///< of two robots against each other; margins allow for it already
  double max_error_s;  ///< beyond it, what a peer promises has no time that means anything
};

struct CommitmentOptions {
  std::string agent;
  std::uint32_t epoch;  ///< one more than at the last start
  int priority;
  double delta_dc_s;
  double reach_timeout_s;
  double peer_clearance_m;
  /// Robots are to be able to stop for each other, the one this time after the other; none: that is
  /// not asked.
  std::optional<double> stop_reaction_s;
  double stop_clearance_m;  ///< what their discs keep then
  double heartbeat_period_s;
  double resend_period_s;
  ClockOptions clocks;
  Reach reach;

  /// As config/trajectory_broadcaster.yaml and the robot's model have it, for the robot `agent`.
  static CommitmentOptions from(const ParameterTable& values, const RobotModel& robot,
                                const Reach& reach, const std::string& agent, std::uint32_t epoch);

  /// Throws std::invalid_argument naming the first value that is out of range.
  void validate() const;
};

}  // namespace mocha
