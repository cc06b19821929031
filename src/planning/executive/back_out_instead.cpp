#include "planning/executive/back_out_instead.h"

#include "planning/maneuvers/back_out.h"

namespace mocha {
namespace {

/// Whether the map, or what is asked of a motion, is the reason: another start may help.
bool depends_on_the_start(PlanReason reason) {
  return reason == PlanReason::kNoPath || reason == PlanReason::kNotCertified ||
         reason == PlanReason::kBudgetExhausted;
}

}  // namespace

void back_out_instead(const PlanQuery& query, const std::vector<Vector2>& trail, double length_m,
                      const MotionLimits& limits, const PlannerInterface& planner,
                      PlanResult& result) {
  const MotionState start = query.committed.at(query.start_time_s);
  if (!start.at_rest || !depends_on_the_start(result.reason)) return;
  const auto motion = back_out_along(trail, start.pose, query.start_time_s, length_m, limits);
  if (!motion || !planner.leads_on(query, *motion)) return;
  result.reason = PlanReason::kBackingOut;
  result.message += "; backs out along the driven path";
  result.motion = *motion;
}

}  // namespace mocha
