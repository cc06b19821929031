#include "stack/delay_cause.h"

namespace mocha {
namespace {

constexpr double kLingers_s = 2.0;  // between two attempts to promise a plan, nothing is wrong

bool is_complaint(PlanReason reason) {
  return reason != PlanReason::kSolved && reason != PlanReason::kNoGoal;
}

}  // namespace

void DelayCause::hear_replanner(const Report& said, double now_s) {
  if (complains_) complained_until_s_ = now_s;
  complains_ = is_complaint(said.reason);
  if (!complains_) return;
  complaint_ = said;
  complaint_.message = "local replanner: " + said.message;
}

DelayCause::Report DelayCause::cause(bool has_plan, double now_s) const {
  const bool counts = complains_ || now_s < complained_until_s_ + kLingers_s;
  return has_plan && counts ? complaint_ : planner_;
}

}  // namespace mocha
