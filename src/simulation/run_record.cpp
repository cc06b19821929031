#include "simulation/run_record.h"

#include <cmath>

namespace mocha {
namespace {

constexpr double kMoved_m = 0.1;
constexpr double kStandingSpeed = 0.02;  // [m/s]
constexpr double kStandingAt_m = 0.15;
constexpr double kStandingHeading_rad = 0.2;
constexpr double kNear_m = 1.0;

}  // namespace

RunRecord::RunRecord(const Pose& start, const std::optional<Goal>& goal, Arrival arrival)
    : start_(start), goal_(goal), arrival_(arrival) {}

void RunRecord::update(double time_s, const Pose& pose, const Twist& twist, const Arc& arc) {
  path_length_m_ += std::abs(arc.length_m);
  if (!moved_at_s_ && (pose.position - start_.position).norm() > kMoved_m) moved_at_s_ = time_s;
  if (!reached_at_s_ && at_goal(pose, twist)) reached_at_s_ = time_s;
}

bool RunRecord::at_goal(const Pose& pose, const Twist& twist) const {
  if (!goal_) return false;
  const double distance = (pose.position - goal_->position).norm();
  if (arrival_ == Arrival::kNear) return distance <= kNear_m;
  if (distance > kStandingAt_m || std::abs(twist.speed) >= kStandingSpeed) return false;
  return !goal_->yaw_rad ||
         std::abs(wrap_angle(pose.yaw_rad - *goal_->yaw_rad)) <= kStandingHeading_rad;
}

}  // namespace mocha
