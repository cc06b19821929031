#include "benchmarks/fleet_options.h"

namespace mocha {
namespace {

ParameterTable broadcaster_values() {
  return ParameterTable::from_schema("config/trajectory_broadcaster.yaml");
}

}  // namespace

ParameterTable global_values(const FleetOptions& options) {
  ParameterTable values = ParameterTable::from_schema("config/global_planner.yaml");
  YAML::Node changes;
  // Planning, the wait for the next step of the local replanner, and settling, as in config/.
  changes["planning_time"] = options.settle_s + 0.2;
  changes["planning_threads"] = options.planning_threads;
  values.assign(changes, "fleet options");
  return values;
}

ParameterTable local_values(const FleetOptions& options) {
  ParameterTable values = ParameterTable::from_schema("config/local_replanner.yaml");
  YAML::Node changes;
  changes["settle_time"] = options.settle_s;
  changes["planning_threads"] = options.planning_threads;
  values.assign(changes, "fleet options");
  return values;
}

Reach reach_of(const RobotModel& robot, const FleetOptions& options) {
  return Reach::from(broadcaster_values(), robot, local_values(options).number("horizon"));
}

CommitmentOptions commitment_options(const std::string& name, const RobotModel& robot,
                                     std::uint32_t epoch, const FleetOptions& options) {
  CommitmentOptions commitment =
      CommitmentOptions::from(broadcaster_values(), robot, reach_of(robot, options), name, epoch);
  commitment.delta_dc_s = options.delta_dc_s;
  return commitment;
}

}  // namespace mocha
