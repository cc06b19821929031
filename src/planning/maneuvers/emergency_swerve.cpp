#include "planning/maneuvers/emergency_swerve.h"

#include <algorithm>
#include <cmath>

#include "trajectory/minco.h"

namespace mocha {
namespace {

constexpr double kSlowest_mps = 0.15;  // below, braking and turning in place is as quick
constexpr double kStep_s = 0.02;
constexpr int kStepsPerKnot = 10;
// A turn of 0.4 s moves the robot aside by a third of a metre, one of 0.8 s by a metre.
constexpr double kHolds_s[] = {0.4, 0.8, 1.2};
constexpr double kYawRates[] = {-1.0, -0.5, 0.5, 1.0};       // shares of the highest
constexpr double kAccelerations[] = {0.5, 0.0, -0.5, -1.0};  // shares of the highest
constexpr double kJerk = 8.0;                                // [m/s^3] along the path
constexpr double kShareOfLimits = 0.85;                      // for the curve between the knots

struct Swerve {
  double hold_s;
  double yaw_rate;
  double acceleration;  // along the path, as far as the circle leaves it
};

/// A unicycle under way, by its course.
struct Rolling {
  Vector2 position;
  double course_rad;
  double speed;
  double yaw_rate;
  double acceleration;  // along the course

  Vector2 along() const { return {std::cos(course_rad), std::sin(course_rad)}; }

  void step(double yaw_rate_wanted, double acceleration_wanted, const MotionLimits& limits) {
    const double most = kShareOfLimits * limits.max_acceleration;
    const double change = limits.max_yaw_acceleration * kStep_s;
    const double tightest = std::min(kShareOfLimits * limits.max_yaw_rate, most / speed);
    yaw_rate += std::clamp(yaw_rate_wanted - yaw_rate, -change, change);
    yaw_rate = std::clamp(yaw_rate, -tightest, tightest);
    const double left = std::sqrt(std::max(0.0, most * most - std::pow(speed * yaw_rate, 2)));
    const double jerk = kJerk * kStep_s;
    acceleration += std::clamp(acceleration_wanted - acceleration, -jerk, jerk);
    acceleration = std::clamp(acceleration, -left, left);
    course_rad += 0.5 * yaw_rate * kStep_s;
    position += kStep_s * std::max(0.0, speed + 0.5 * acceleration * kStep_s) * along();
    course_rad += 0.5 * yaw_rate * kStep_s;
    const double fastest = std::max(speed, kShareOfLimits * limits.max_speed);
    speed = std::clamp(speed + acceleration * kStep_s, 0.0, fastest);
  }
};

/// The places at equal steps, from the state on; the last one is at rest.
std::vector<Vector2> driven(Rolling rolling, const Swerve& swerve, const MotionLimits& limits,
                            double& final_course_rad) {
  std::vector<Vector2> places = {rolling.position};
  const double braking = -limits.max_acceleration;
  for (int i = 0; rolling.speed > 1e-3 && i * kStep_s < 10.0; ++i) {
    const bool holds = i * kStep_s < swerve.hold_s;
    const double yaw_rate = holds ? swerve.yaw_rate : 0.0;
    rolling.step(yaw_rate, holds ? swerve.acceleration : braking, limits);
    places.push_back(rolling.position);
  }
  final_course_rad = rolling.course_rad;
  return places;
}

DrivePhase drive_of(const MotionState& start, const Swerve& swerve, const MotionLimits& limits) {
  const Rolling rolling{start.pose.position, std::atan2(start.velocity.y(), start.velocity.x()),
                        std::abs(start.speed), start.yaw_rate,
                        start.acceleration.dot(start.velocity.normalized())};
  double course_rad = 0.0;
  const std::vector<Vector2> places = driven(rolling, swerve, limits, course_rad);
  const int steps = static_cast<int>(places.size()) - 1;
  const int pieces = std::max(1, steps / kStepsPerKnot);
  const double duration_s = kStep_s * steps / pieces;
  PlanarMinco::Knots knots(2, pieces - 1);
  for (int k = 1; k < pieces; ++k) {
    const double at = static_cast<double>(k) * steps / pieces;
    const int i = static_cast<int>(at);
    knots.col(k - 1) = places[i] + (at - i) * (places[i + 1] - places[i]);
  }
  PlanarMinco::State from;
  PlanarMinco::State to;
  from << start.pose.position, start.velocity, start.acceleration;
  // Ending on the deceleration: the heading at rest is then well defined.
  to << places.back(), Vector2::Zero(),
      -kShareOfLimits * limits.max_acceleration *
          Vector2(std::cos(course_rad), std::sin(course_rad));
  PlanarMinco minco;
  minco.resize(pieces);
  minco.solve(from, to, knots, Eigen::VectorXd::Constant(pieces, duration_s));
  return {start.speed < 0.0 ? -1 : 1, minco.curve()};
}

}  // namespace

Maneuvers emergency_swerves(const ManeuverStart& start) {
  const double join_s = start.emergency_s;
  const MotionState state = start.committed.at(join_s);
  if (std::abs(state.speed) < kSlowest_mps || !is_alone(start)) return {};
  MotionLimits limits = start.robot.limits;
  limits.max_acceleration = start.robot.hard_braking().deceleration();
  Maneuvers maneuvers;
  for (const double hold_s : kHolds_s) {
    for (const double yaw_rate : kYawRates) {
      for (const double acceleration : kAccelerations) {
        const Swerve swerve{hold_s, yaw_rate * limits.max_yaw_rate,
                            acceleration * limits.max_acceleration};
        auto motion = Motion::make(join_s, {drive_of(state, swerve, limits)});
        if (!motion) continue;
        maneuvers.push_back(
            whole(std::move(motion.motion), join_s, true, "swerves, which keeps the most room"));
      }
    }
  }
  return maneuvers;
}

}  // namespace mocha
