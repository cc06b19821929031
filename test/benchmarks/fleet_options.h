#pragma once

#include <cstdint>
#include <string>

#include "config/parameter_table.h"
#include "fleet/protocol/commitment_options.h"
#include "world/robot_model.h"

namespace mocha {

enum class Protocol { kOnePhase, kTwoPhase };

/// How a fleet runs; whatever is not named here is as config/ says.
struct FleetOptions {
  Protocol protocol = Protocol::kTwoPhase;
  double delta_dc_s = 0.06;
  double settle_s = 0.3;          ///< settle_time of the local replanner
  double tracking_error_m = 0.0;  ///< of the true place off the promised one, in turning directions
  int planning_threads = 0;       ///< 0: one on each core
};

ParameterTable global_values(const FleetOptions& options);
ParameterTable local_values(const FleetOptions& options);
Reach reach_of(const RobotModel& robot, const FleetOptions& options);
CommitmentOptions commitment_options(const std::string& name, const RobotModel& robot,
                                     std::uint32_t epoch, const FleetOptions& options);

}  // namespace mocha
