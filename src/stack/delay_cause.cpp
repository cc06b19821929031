#include "stack/delay_cause.h"

#include <sstream>

namespace mocha {
namespace {

constexpr double kLingers_s = 2.0;  // between two attempts to promise a plan, nothing is wrong

bool is_complaint(PlanReason reason) {
  return reason != PlanReason::kSolved && reason != PlanReason::kNoGoal;
}

}  // namespace

void DelayCause::hear_planning_time(double took_s, double allowed_s) {
  std::ostringstream words;
  words.precision(2);
  if (took_s > allowed_s)
    words << "; planning took " << took_s << " s, planning_time is " << allowed_s << " s";
  lateness_ = words.str();
}

void DelayCause::hear_replanner(const Report& said, double now_s) {
  if (complains_) complained_until_s_ = now_s;
  complains_ = is_complaint(said.reason);
  if (!complains_) return;
  complaint_ = said;
  complaint_.message = "local replanner: " + said.message;
}

DelayCause::Report DelayCause::cause(bool has_plan, double now_s) const {
  const bool counts = complains_ || now_s < complained_until_s_ + kLingers_s;
  if (!has_plan || !counts) return planner_;
  Report late = complaint_;
  late.message += lateness_;
  return late;
}

}  // namespace mocha
