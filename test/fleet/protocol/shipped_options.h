#pragma once

#include <string>

#include "fleet/protocol/commitment_options.h"

namespace mocha::test {

/// What config/ ships, for a robot of the default model.
inline CommitmentOptions shipped_options(const std::string& agent, std::uint32_t epoch = 1) {
  return CommitmentOptions::from(ParameterTable::from_schema("config/trajectory_broadcaster.yaml"),
                                 load_robot_model("config", "rover"), agent, epoch);
}

}  // namespace mocha::test
