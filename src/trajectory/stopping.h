#pragma once

#include <vector>

#include "trajectory/braking.h"
#include "trajectory/motion.h"

namespace mocha {

// Braking motions.
//
// Guaranteed: they begin at the given position, velocity and acceleration, end at rest, and meet
// the path again at every knot (0.2 s apart or less). Typical, for motions as they are planned:
// they leave the path by millimetres between knots, and exceed an acceleration limit that the
// motion keeps by less than 15 %, if the deceleration is at most 0.7 of it. Whether a particular
// one may be driven is for the certificate to say.

/// From the motion's state at absolute time t to rest along its own path, never faster than the
/// motion itself is at the same place. Where the motion comes to rest no later on the path, that is
/// what is returned, exactly. A turn in place that is under way is ended (turn_to_rest()). At rest,
/// or slower than 1 mm/s: a short stand.
std::vector<Phase> brake_along(const Motion& motion, double t, const Braking& braking);

/// For a robot off its motion: from `speed` [m/s] (negative: backward) to rest. It stays on the
/// circle on which it is by `yaw_rate` [rad/s], which dies with the speed; straight ahead if that
/// is 0. Slower than 1 mm/s, it ends a turn in place, or stands.
std::vector<Phase> brake_from(const Pose& pose, double speed, double yaw_rate,
                              const Braking& braking);

/// The motion from t0 to t_brake, then braking along it.
Motion with_brake(const Motion& motion, double t0, double t_brake, const Braking& braking);

/// The same; where its parts do not join, it is none and the fault says why. with_brake() throws
/// std::invalid_argument there.
MotionOrFault try_brake(const Motion& motion, double t0, double t_brake, const Braking& braking);

}  // namespace mocha
