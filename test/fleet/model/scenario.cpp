#include "fleet/model/scenario.h"

namespace mocha::test {

CommitmentOptions options_of(const Scenario& scenario, int i, std::uint32_t epoch) {
  CommitmentOptions options{};
  options.agent = name_of_robot(i);
  options.epoch = epoch;
  options.priority = scenario.robots[i].priority;
  options.delta_dc_s = kStep_s;
  options.reach_timeout_s = 4.0 * kStep_s;
  options.peer_clearance_m = 0.2;
  options.heartbeat_period_s = 2.0 * kStep_s;
  options.resend_period_s = 4.0 * kStep_s;
  options.clocks = {kStep_s, 0.25};
  options.reach = scenario.reach;
  return options;
}

std::string name_of_robot(int i) { return "ugv" + std::to_string(i + 1); }

}  // namespace mocha::test
