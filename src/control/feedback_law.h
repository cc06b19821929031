#pragma once

#include "config/parameter_table.h"
#include "trajectory/motion.h"
#include "trajectory/unicycle.h"

namespace mocha {

/// Offset of the robot from where it should be, in the reference's frame: ahead, left and turned
/// left are positive.
struct TrackingError {
  double along_m = 0.0;
  double across_m = 0.0;
  double heading_rad = 0.0;

  double position_m() const;
};

TrackingError tracking_error(const Pose& pose, const Pose& reference);

struct FeedbackGains {
  double along = 4.0;              ///< [1/s] of the error along the heading
  double across = 2.5;             ///< [1/m] bandwidth of the error across, per speed
  double max_bandwidth = 4.0;      ///< [rad/s] of the error across, whatever the speed
  double damping = 1.0;            ///< of the error across
  double heading = 3.0;            ///< [1/s] of the heading error, at least
  double settle_start_rad = 0.05;  ///< standing, a larger heading error starts a correction ...
  double settle_stop_rad = 0.01;   ///< ... that ends below this one

  /// Values of config/trajectory_tracker.yaml.
  static FeedbackGains from(const ParameterTable& values);
};

/// The speed and yaw rate that bring a robot at `pose` back onto a moving reference: Kanayama's and
/// Samson's law
///
///     speed    = v cos(e_h) + k_x e_x
///     yaw rate = w + (b^2 / v) sinc(e_h) e_y + k_h e_h,   b = min(across |v|, max_bandwidth), k_h
///     = max(heading, 2 damping b)
///
/// with the reference's offset (e_x, e_y, e_h) in the body frame and `feedforward` (v, w). For b =
/// across |v|, the function across^2 (e_x^2 + e_y^2) + e_h^2 falls all the time, forward and
/// backward. The speed never gets the sign opposite to v, and v = 0 (a turn in place) commands no
/// speed: a robot that is too far ahead waits.
UnicycleState feedback(const Pose& pose, const Pose& reference, const UnicycleState& feedforward,
                       const FeedbackGains& gains);

}  // namespace mocha
