#pragma once

#include <string>

#include "fleet/protocol/commitment_options.h"

namespace mocha::test {

/// What config/ ships, for a robot of the default model.
inline CommitmentOptions shipped_options(const std::string& agent, std::uint32_t epoch = 1) {
  const auto values = ParameterTable::from_schema("config/trajectory_broadcaster.yaml");
  const auto local_values = ParameterTable::from_schema("config/local_replanner.yaml");
  const RobotModel robot = load_robot_model("config", "rover");
  return CommitmentOptions::from(
      values, robot, Reach::from(values, robot, local_values.number("horizon")), agent, epoch);
}

}  // namespace mocha::test
