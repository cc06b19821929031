#pragma once

#include <optional>

#include "config/parameter_table.h"
#include "planning/executive/executive_state.h"
#include "planning/executive/goal_queue.h"

namespace mocha {

/// When to plan and what to drive; each stands in config/global_planner.yaml.
struct GoalExecutiveOptions {
  double planning_time_s;  ///< a plan takes over this long after planning began
  double handover_s;       ///< of that, what a plan needs until the robot is bound to it
  double replan_period_s;
  double retry_period_s;   ///< after a failure
  double min_improvement;  ///< of the remaining time, for a plan to replace a valid one
  double occupied_goal_timeout_s;
  double unreachable_timeout_s;
  GoalOptions goals;

  /// Time between two plans in this state [s]; none where no plan is needed.
  std::optional<double> planning_period_s(ExecutiveState state) const;

  /// How long the goals are kept in this state [s]; none where `goals.timeout_s` alone counts.
  std::optional<double> patience_s(ExecutiveState state) const;

  static GoalExecutiveOptions from(const ParameterTable& values, double handover_s);
};

}  // namespace mocha
