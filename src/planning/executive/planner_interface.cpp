#include "planning/executive/planner_interface.h"

namespace mocha {
namespace {

/// Whether the map, or what is asked of a motion, is the reason: another start may help.
bool depends_on_the_start(PlanReason reason) {
  return reason == PlanReason::kNoPath || reason == PlanReason::kNotCertified ||
         reason == PlanReason::kBudgetExhausted;
}

}  // namespace

void back_out_instead(const PlanQuery& query, const PlannerInterface& planner, PlanResult& result) {
  const bool at_rest = query.committed.at(query.start_time_s).at_rest;
  if (!at_rest || !depends_on_the_start(result.reason)) return;
  const auto motion = planner.back_out(query);
  if (!motion) return;
  result.reason = PlanReason::kBackingOut;
  result.message += "; backs out along the driven path";
  result.motion = *motion;
}

}  // namespace mocha
