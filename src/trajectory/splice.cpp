#include "trajectory/splice.h"

#include <algorithm>
#include <utility>

namespace mocha {
namespace {

constexpr double kStandAtJoint_s = 0.1;
constexpr double kShortest_s = 1e-5;  // shorter waits are rounding of absolute times

/// The phases of a motion between two times, with its standing before and after.
std::vector<Phase> phases_with_stands(const Motion& motion, double from_s, double until_s) {
  std::vector<Phase> phases;
  const auto stand = [&phases](const Pose& pose, double duration_s) {
    if (duration_s > kShortest_s) phases.emplace_back(StandPhase{pose, duration_s});
  };
  stand(motion.at(motion.start_time()).pose, std::min(until_s, motion.start_time()) - from_s);
  for (Phase& phase : motion.phases_between(from_s, until_s)) phases.push_back(std::move(phase));
  stand(motion.end_pose(), until_s - std::max(from_s, motion.end_time()));
  return phases;
}

}  // namespace

MotionOrFault splice(double start_time_s, std::vector<Phase> head, const Motion& tail,
                     double tail_from_s) {
  const double until_s = std::max(tail_from_s, tail.end_time());
  std::vector<Phase> rest = phases_with_stands(tail, tail_from_s, until_s);
  const bool over = rest.empty();
  if (over) rest.emplace_back(StandPhase{tail.end_pose(), head.empty() ? kStandAtJoint_s : 0.0});
  for (Phase& phase : rest) head.push_back(std::move(phase));
  MotionOrFault whole = Motion::make(start_time_s, head);
  if (!whole || !over || head.size() == 1) return whole;
  head.pop_back();  // the head ends where the tail stands, which is all that there was to see
  return Motion::make(start_time_s, std::move(head));
}

MotionOrFault splice(const Motion& first, double from_s, double join_s, const Motion& second) {
  const double begin_s = std::max(from_s, std::min(first.start_time(), join_s));
  return splice(begin_s, phases_with_stands(first, begin_s, join_s), second, join_s);
}

Motion rest_of(const Motion& motion, double from_s) {
  from_s = std::max(from_s, motion.start_time());
  std::vector<Phase> phases = motion.phases_between(from_s, motion.end_time());
  if (phases.empty()) phases.emplace_back(StandPhase{motion.end_pose(), kStandAtJoint_s});
  return Motion(from_s, std::move(phases));
}

}  // namespace mocha
