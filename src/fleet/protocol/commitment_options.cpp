#include "fleet/protocol/commitment_options.h"

#include <stdexcept>

#include "world/margin_budget.h"

namespace mocha {
namespace {

void require(bool condition, const char* name, double value, const char* range) {
  if (condition) return;
  throw std::invalid_argument(std::string(name) + " = " + std::to_string(value) + ", allowed is " +
                              range);
}

}  // namespace

CommitmentOptions CommitmentOptions::from(const ParameterTable& values, const RobotModel& robot,
                                          const Reach& reach, const std::string& agent,
                                          std::uint32_t epoch) {
  const MarginBudget margins = MarginBudget::of(robot);
  CommitmentOptions options;
  options.agent = agent;
  options.epoch = epoch;
  options.priority = values.integer("priority");
  options.delta_dc_s = values.number("delta_dc");
  options.reach_timeout_s = values.number("reach_timeout");
  options.peer_clearance_m = robot.peer_clearance_m + margins.peer_margin_m();
  if (robot.stops_checked) options.stop_reaction_s = robot.peer_reaction_s;
  options.stop_clearance_m = margins.peer_margin_m();
  options.heartbeat_period_s = 1.0 / values.number("heartbeat_rate");
  options.resend_period_s = 1.0 / values.number("resend_rate");
  options.clocks = {2.0 * margins.clock_s, values.number("max_clock_error")};
  options.reach = reach;
  return options;
}

void CommitmentOptions::validate() const {
  if (agent.empty()) throw std::invalid_argument("the robot has no name");
  require(delta_dc_s >= 0.0, "delta_dc", delta_dc_s, "0 s or more");
  require(peer_clearance_m >= 0.0, "peer_clearance", peer_clearance_m, "0 m or more");
  require(stop_clearance_m >= 0.0, "stop clearance", stop_clearance_m, "0 m or more");
  require(heartbeat_period_s > 0.0, "heartbeat period", heartbeat_period_s, "above 0 s");
  require(resend_period_s > 0.0, "resend period", resend_period_s, "above 0 s");
  require(clocks.tolerance_s >= 0.0, "clock tolerance", clocks.tolerance_s, "0 s or more");
  require(clocks.max_error_s >= 0.0, "max_clock_error", clocks.max_error_s, "0 s or more");
  require(reach.promise_m > 0.0, "promise reach", reach.promise_m, "above 0 m");
  require(reach.fleet_speed > 0.0, "fleet_speed", reach.fleet_speed, "above 0 m/s");
}

}  // namespace mocha
