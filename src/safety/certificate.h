#pragma once

#include <limits>
#include <string>

#include "trajectory/motion.h"
#include "world/footprint.h"
#include "world/moving_obstacle.h"
#include "world/obstacle_field.h"
#include "world/robot_model.h"

namespace mocha {

/// What a motion violates.
enum class ViolatedTerm {
  kNothing,
  kClearance,     ///< [m] footprint to static obstacle
  kSpeed,         ///< [m/s]
  kAcceleration,  ///< [m/s^2] of the base, or [rad/s^2] of a turn in place
  kYawRate,       ///< [rad/s]
  kSeparation,    ///< [m] own disc to a moving obstacle's disc
  kUnseenSpace,   ///< cannot stop inside space that was seen free
};

/// The first moment at which a motion breaks a limit; false if there is none.
struct Violation {
  ViolatedTerm term = ViolatedTerm::kNothing;
  double time_s = 0.0;              ///< absolute
  Vector2 place = Vector2::Zero();  ///< [m] of the base, map frame
  /// The worst of the stretch that begins at time_s, in the unit of the term; infinite where the
  /// heading flips because the velocity passes through zero within a drive.
  double value = 0.0;
  double limit = 0.0;  ///< in the unit of the term; a minimum for distances, a maximum otherwise
  std::string peer;    ///< kSeparation: name of the moving obstacle

  explicit operator bool() const { return term != ViolatedTerm::kNothing; }
};

/// In words: what is violated, where, when and by how much. "no violation" if there is none.
std::string describe(const Violation& violation);

// Each check proves its property for all times from `from_s` (absolute) on, in continuous time, and
// returns the first violation; a motion that begins later is checked from its start. What is
// accepted holds; what is refused is violated or within rounding distance of it: 1 mm for
// distances, a share of 1e-6 for limits.

/// Speed, acceleration and yaw rate of drives; yaw rate and yaw acceleration of turns in place.
Violation check_limits(const Motion& motion, const MotionLimits& limits, double from_s);

/// The footprint's cover discs keep `margin_m` >= 0 to all obstacles of the field.
Violation check_clearance(const Motion& motion, const Footprint& footprint,
                          const ObstacleField<2>& field, double margin_m, double from_s);

/// The disc of `own_radius_m` keeps `clearance_m` to the obstacle's disc, until both rest or
/// `until_s`, whichever is first. Throws std::invalid_argument if neither is finite.
Violation check_separation(const Motion& motion, double own_radius_m,
                           const MovingObstacle& obstacle, double clearance_m, double from_s,
                           double until_s = std::numeric_limits<double>::infinity());

}  // namespace mocha
