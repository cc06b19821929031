#include "planning/maneuvers/emergency_swerve.h"

#include <cmath>

#include "planning/maneuvers/rolling.h"

namespace mocha {
namespace {

constexpr double kSlowest_mps = 0.15;  // below, braking and turning in place is as quick
constexpr double kStep_s = 0.02;
// A turn of 0.4 s moves the robot aside by a third of a metre, one of 0.8 s by a metre.
constexpr double kHolds_s[] = {0.4, 0.8, 1.2};
constexpr double kYawRates[] = {-1.0, -0.5, 0.5, 1.0};       // shares of the highest
constexpr double kAccelerations[] = {0.5, 0.0, -0.5, -1.0};  // shares of the highest

struct Swerve {
  double hold_s;
  double yaw_rate;
  double acceleration;  // along the path, as far as the circle leaves it
};

/// The places at equal steps, from the state on; the last one is at rest.
std::vector<Vector2> driven(Rolling rolling, const Swerve& swerve, const MotionLimits& limits,
                            double& final_course_rad) {
  std::vector<Vector2> places = {rolling.position};
  const double braking = -limits.max_acceleration;
  for (int i = 0; rolling.speed > 1e-3 && i * kStep_s < 10.0; ++i) {
    const bool holds = i * kStep_s < swerve.hold_s;
    const double yaw_rate = holds ? swerve.yaw_rate : 0.0;
    rolling.step(kStep_s, yaw_rate, holds ? swerve.acceleration : braking, limits);
    places.push_back(rolling.position);
  }
  final_course_rad = rolling.course_rad;
  return places;
}

DrivePhase drive_of(const MotionState& start, const Swerve& swerve, const MotionLimits& limits) {
  double course_rad = 0.0;
  const std::vector<Vector2> places = driven(Rolling::from(start), swerve, limits, course_rad);
  return drive_through(start, places, kStep_s, course_rad, limits);
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
