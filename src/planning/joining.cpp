#include "planning/joining.h"

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "planning/promise_builder.h"

namespace mocha {
namespace {

constexpr double kTolerance_m = 0.01;
constexpr double kTolerance_rad = 0.03;
constexpr double kTolerance_mps = 0.03;

bool agree(const MotionState& a, const MotionState& b) {
  return (a.pose.position - b.pose.position).norm() <= kTolerance_m &&
         std::abs(wrap_angle(a.pose.yaw_rad - b.pose.yaw_rad)) <= kTolerance_rad &&
         (a.velocity - b.velocity).norm() <= kTolerance_mps;
}

}  // namespace

std::optional<Motion> joined(const Motion& committed, const Motion& plan, double now_s,
                             double join_s) {
  try {
    std::vector<Phase> onward = plan.phases_between(join_s, plan.end_time());
    if (onward.empty()) return std::nullopt;
    return continued(committed, now_s, join_s, Motion(join_s, std::move(onward)));
  } catch (const std::invalid_argument&) {
    return std::nullopt;  // they do not meet, or the plan is in the midst of a turn in place
  }
}

std::optional<Motion> postponed(const Motion& committed, const Motion& plan, double join_s) {
  if (plan.start_time() >= join_s) return std::nullopt;
  const MotionState here = committed.at(join_s);
  const MotionState start = plan.at(plan.start_time());
  if (!here.at_rest || !start.at_rest || !agree(here, start)) return std::nullopt;
  return Motion(join_s, plan.phases());
}

}  // namespace mocha
