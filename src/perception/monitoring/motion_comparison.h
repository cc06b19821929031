#pragma once

#include <deque>
#include <optional>

#include "trajectory/motion.h"

namespace mocha {

/// How the motion that scans show differs from that of the odometry.
struct MotionDifference {
  double lag_s = 0.0;  ///< by so much the scans are older than they say, where their motion shows
                       ///< that clearly; else 0
  double turn_rad = 0.0;        ///< the lidar is mounted so much further to the left than is known
  double turn_error_rad = 0.0;  ///< standard deviation of that
  double slip = 0.0;        ///< share by which the odometry reports more travel than the scans show
  double slip_error = 0.0;  ///< standard deviation of that
};

/// Compares the motion between scans, as they show it, with the odometry: over the newest travel,
/// the lag, the turn and the scale that explain the scans' steps best by those of the odometry
/// (least squares).
class MotionComparison {
 public:
  /// Compared are the newest `travel_m`, or what is newer than a few seconds.
  explicit MotionComparison(double travel_m) : travel_m_(travel_m) {}

  /// A scan: base_link in the odometry frame at its time, and as seen from where it was at the scan
  /// before; nothing where the scans do not tell that.
  void add(double time_s, const Pose& odometry, const std::optional<Pose>& step);

  /// Nothing without enough travel or turning. `range_noise_m` is the lidar's, with which a step by
  /// the scans scatters.
  std::optional<MotionDifference> difference(double range_noise_m) const;

  /// How far the robot has come by the scans, within a second at most, up to now, while the
  /// odometry stood [m]; a radian of turning counts as 0.5 m.
  double unreported_travel_m() const;

  void clear() { steps_.clear(); }

 private:
  struct Step {
    double begin_s;
    double end_s;
    Pose scan;
  };
  struct Fit;

  Pose odometry_at(double time_s) const;
  Pose odometry_step(const Step& step, double lag_s) const;
  Fit fit(double lag_s) const;
  void forget_old(double now_s);

  double travel_m_;
  std::deque<Step> steps_;
  std::deque<std::pair<double, Pose>> odometry_;  // by time, longer than the steps by a lag
};

}  // namespace mocha
