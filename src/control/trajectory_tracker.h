#pragma once

#include <optional>
#include <string>

#include "control/command_limiter.h"
#include "control/feedback_law.h"
#include "control/lease.h"
#include "control/robot_state.h"
#include "control/tracker_mode.h"
#include "trajectory/motion.h"
#include "world/robot_model.h"
#include "world/speed_margin.h"

namespace mocha {

struct TrackerParameters {
  FeedbackGains gains;
  double max_heading_error_rad = 0.6;  ///< beyond, the robot stops
  double max_pose_age_s = 0.25;        ///< a pose older than this is not used
  double command_delay_s =
      0.01;  ///< from the pose to the command at the wheels, without their own lag

  /// Values of config/trajectory_tracker.yaml.
  static TrackerParameters from(const ParameterTable& values);
};

/// Drives committed motions, 50 times a second, and stops where it may not or cannot. It never
/// slips time: the reference at time t is the motion at time t.
///
/// A motion is driven only under a lease. The lease expired, the robot brakes along the path; from
/// then on only a new motion, which starts where the robot really is, makes it move again. So it is
/// after an emergency stop, which goes before everything else.
class TrajectoryTracker {
 public:
  /// Throws std::invalid_argument for bounds and gains that are not positive.
  TrajectoryTracker(const TrackerParameters& parameters, const RobotModel& robot);

  /// From the next step() on. Throws std::invalid_argument for gains that are not positive; then
  /// nothing changes.
  void set_gains(const FeedbackGains& gains);

  /// Offers a newly committed motion, with a lease until `lease_end_s` (in the past: none). It is
  /// taken up by the first step() that has both a lease and a pose for it, if it fits the pose
  /// then; else it is refused and driving goes on as before. A motion that is known already, or
  /// older than a known one of the same epoch, is ignored.
  void offer(const MotionId& id, Motion motion, double lease_end_s);

  /// Sets the end of the lease of one motion, also of one that is still to be offered.
  void renew(const MotionId& id, double lease_end_s);

  /// Emergency stop, or its end, from the next step() on: the wheels are stopped as hard as they
  /// can be, on the curve that they are on, and stay so. After its end only a motion that is
  /// offered then is driven. `reason` is for people.
  void set_stopped(bool stopped, const std::string& reason);

  /// The command at time t [s] for the newest known state. Steps are expected at a steady rate,
  /// with t rising.
  UnicycleState step(double t, const std::optional<RobotState>& state);

  TrackerMode mode() const { return mode_; }
  /// Of the last step; nothing without a motion or a pose.
  const std::optional<TrackingError>& error() const { return error_; }
  /// What the robot follows; empty before the first.
  const Motion& motion() const { return active_.motion; }
  /// How often that has become another one.
  int motions() const { return motions_; }
  const MotionId& id() const { return active_.id; }
  double lease_end() const { return active_.lease_end_s; }
  /// Why the robot stopped, with values; empty while it drives.
  const std::string& stop_reason() const { return stop_reason_; }
  int refused() const { return refused_; }
  const std::string& refusal() const { return refusal_; }  ///< of the motion refused last

 private:
  struct CommitmentProtocol {
    MotionId id;
    Motion motion;
    double lease_end_s = 0.0;
  };

  void take_up_offer(double t, const Pose& pose, double speed);
  void update_mode(double t, const std::optional<Pose>& pose);
  void handle(TrackerEvent event, double t, const std::string& reason);
  /// How far off the reference the base may be [m].
  double allowed_m(const MotionState& reference) const;
  std::string misfit(const TrackingError& error, const MotionState& reference) const;
  std::string too_fast(const TrackingError& error, double speed,
                       const MotionState& reference) const;
  UnicycleState wanted(double t, const Pose& pose);
  double settling_yaw_rate(double heading_error_rad);
  bool stands(double t) const;

  TrackerParameters parameters_;
  SpeedMargin max_position_error_;  // e_track, for which the motions were certified
  double max_speed_;
  double lag_s_;
  double lead_s_;  // a command takes effect this much later
  Braking braking_;
  double catch_up_acceleration_;
  CommandLimiter limiter_;

  TrackerMode mode_ = TrackerMode::kIdle;
  CommitmentProtocol active_;
  int motions_ = 0;
  std::optional<CommitmentProtocol> offer_;
  std::optional<CommitmentProtocol> early_lease_;  // without a motion yet
  std::optional<TrackingError> error_;
  std::optional<double> last_step_s_;
  double settling_rad_ = 0.0;     // what is corrected while standing; 0: nothing
  double settle_widening_ = 1.0;  // of the dead band
  bool stopped_ = false;
  std::string order_;  // why stopped_
  std::string stop_reason_;
  std::string refusal_;
  int refused_ = 0;
};

}  // namespace mocha
