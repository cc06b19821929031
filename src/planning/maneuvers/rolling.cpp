#include "planning/maneuvers/rolling.h"

#include <algorithm>
#include <cmath>

#include "trajectory/braking.h"
#include "trajectory/minco.h"

namespace mocha {
namespace {

constexpr double kKnot_s = 0.2;
constexpr double kJerk = 8.0;            // [m/s^3] along the path
constexpr double kShareForCurve = 0.85;  // for the curve between the knots
constexpr double kShareOfYawRate = 0.75;
constexpr double kTightest_m = 0.2;  // radius; tighter, the curve between knots turns too fast

Vector2 direction(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

}  // namespace

Rolling Rolling::from(const MotionState& state) {
  const double speed = std::abs(state.speed);
  const double yaw = state.pose.yaw_rad + (state.speed < 0.0 ? M_PI : 0.0);
  if (speed < kRest_mps) return {state.pose.position, yaw, 0.0, 0.0, 0.0};
  return {state.pose.position, std::atan2(state.velocity.y(), state.velocity.x()), speed,
          state.yaw_rate, state.acceleration.dot(state.velocity.normalized())};
}

Rolling Rolling::setting_off(const Pose& from, double turn_rad, const MotionLimits& limits) {
  return {from.position, from.yaw_rad + turn_rad, 0.0, 0.0,
          kShareForCurve * limits.max_acceleration};
}

Vector2 Rolling::along() const { return direction(course_rad); }

void Rolling::step(double duration_s, double yaw_rate_wanted, double acceleration_wanted,
                   const MotionLimits& limits) {
  const double most = kShareForCurve * limits.max_acceleration;
  const double change = limits.max_yaw_acceleration * duration_s;
  const double tightest =
      std::min({kShareOfYawRate * limits.max_yaw_rate, most / speed, speed / kTightest_m});
  yaw_rate += std::clamp(yaw_rate_wanted - yaw_rate, -change, change);
  yaw_rate = std::clamp(yaw_rate, -tightest, tightest);
  const double left = std::sqrt(std::max(0.0, most * most - std::pow(speed * yaw_rate, 2)));
  const double jerk = kJerk * duration_s;
  acceleration += std::clamp(acceleration_wanted - acceleration, -jerk, jerk);
  acceleration = std::clamp(acceleration, -left, left);
  const double fastest = std::max(speed, kShareForCurve * limits.max_speed);
  const double before = speed;
  speed = std::clamp(speed + acceleration * duration_s, 0.0, fastest);
  acceleration = (speed - before) / duration_s;
  course_rad += 0.5 * yaw_rate * duration_s;
  position += 0.5 * duration_s * (before + speed) * along();
  course_rad += 0.5 * yaw_rate * duration_s;
}

DrivePhase drive_through(const MotionState& start, const std::vector<Vector2>& places,
                         double step_s, double final_course_rad, const MotionLimits& limits) {
  const int steps = static_cast<int>(places.size()) - 1;
  const int pieces = std::max(1, static_cast<int>(steps * step_s / kKnot_s));
  PlanarMinco::Knots knots(2, pieces - 1);
  for (int k = 1; k < pieces; ++k) {
    const double at = static_cast<double>(k) * steps / pieces;
    const int i = static_cast<int>(at);
    knots.col(k - 1) = places[i] + (at - i) * (places[i + 1] - places[i]);
  }
  PlanarMinco::State from;
  PlanarMinco::State to;
  from << start.pose.position, start.velocity, start.acceleration;
  // Ending on the deceleration: the heading at rest is then well defined. So is it at the start.
  const double hard = kShareForCurve * limits.max_acceleration;
  if (start.at_rest) from.col(2) = hard * direction(start.pose.yaw_rad);
  to << places.back(), Vector2::Zero(), -hard * direction(final_course_rad);
  PlanarMinco minco;
  minco.resize(pieces);
  minco.solve(from, to, knots, Eigen::VectorXd::Constant(pieces, steps * step_s / pieces));
  return {start.speed < 0.0 ? -1 : 1, minco.curve()};
}

}  // namespace mocha
