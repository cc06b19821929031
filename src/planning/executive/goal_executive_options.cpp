#include "planning/executive/goal_executive_options.h"

namespace mocha {
namespace {

constexpr double kSoonest_s = 0.2;  // between two plans, whatever is requested

}  // namespace

GoalExecutiveOptions GoalExecutiveOptions::from(const ParameterTable& values, double handover_s) {
  return {values.number("planning_time"),       handover_s,
          values.number("replan_period"),       values.number("retry_period"),
          values.number("min_improvement"),     values.number("occupied_goal_timeout"),
          values.number("unreachable_timeout"), GoalOptions::from(values)};
}

std::optional<double> GoalExecutiveOptions::planning_period_s(ExecutiveState state) const {
  using S = ExecutiveState;
  switch (state) {
    case S::kPlanning:
    case S::kReplanning:
      return kSoonest_s;
    case S::kDriving:
      return replan_period_s;
    case S::kBlocked:
    case S::kGoalOccupied:
    case S::kUnreachable:
      return retry_period_s;
    case S::kIdle:
    case S::kParked:
    case S::kPaused:
    case S::kBraking:
    case S::kWaiting:
      break;
  }
  return std::nullopt;
}

std::optional<double> GoalExecutiveOptions::patience_s(ExecutiveState state) const {
  if (state == ExecutiveState::kGoalOccupied) return occupied_goal_timeout_s;
  if (state == ExecutiveState::kUnreachable) return unreachable_timeout_s;
  return std::nullopt;
}

}  // namespace mocha
