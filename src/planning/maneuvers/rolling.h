#pragma once

#include <vector>

#include "trajectory/motion.h"
#include "world/robot_model.h"

namespace mocha {

/// A unicycle under way, by its course: it changes its yaw rate and its acceleration no faster than
/// it can.
struct Rolling {
  Vector2 position;
  double course_rad;
  double speed;  ///< [m/s] along the course, at least 0
  double yaw_rate;
  double acceleration;  ///< [m/s^2] along the course

  static Rolling from(const MotionState& state);
  /// From rest, after a turn in place, with all its acceleration: as drive_through() begins.
  static Rolling setting_off(const Pose& from, double turn_rad, const MotionLimits& limits);

  Vector2 along() const;
  /// For a while, towards a yaw rate and an acceleration, as far as the limits allow both together.
  /// The way leaves some of the limits to the curve that is laid through it.
  void step(double duration_s, double yaw_rate_wanted, double acceleration_wanted,
            const MotionLimits& limits);
};

/// The motion through places at equal times, from a state (whose place is the first one) to rest at
/// the last, on a course there.
DrivePhase drive_through(const MotionState& start, const std::vector<Vector2>& places,
                         double step_s, double final_course_rad, const MotionLimits& limits);

}  // namespace mocha
