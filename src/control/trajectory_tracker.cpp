#include "control/trajectory_tracker.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "trajectory/splice.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

constexpr double kFirstStep_s = 0.02;
constexpr double kLongestStep_s =
    0.1;  // after a pause the wheels do not get more of a jump than this allows
constexpr double kRestSpeed = 0.01;  // [m/s]

template <typename... Values>
std::string format(const char* pattern, Values... values) {
  char text[200];
  std::snprintf(text, sizeof(text), pattern, values...);
  return text;
}

void require_positive(double value, const char* name) {
  if (value > 0.0 && std::isfinite(value)) return;
  throw std::invalid_argument(
      format("TrajectoryTracker: %s = %g, expected a positive number", name, value));
}

}  // namespace

TrackerParameters TrackerParameters::from(const ParameterTable& values) {
  TrackerParameters parameters;
  parameters.gains = FeedbackGains::from(values);
  parameters.max_heading_error_rad = values.number("max_heading_error");
  parameters.max_pose_age_s = values.number("max_pose_age");
  parameters.command_delay_s = values.number("command_delay");
  return parameters;
}

TrajectoryTracker::TrajectoryTracker(const TrackerParameters& parameters, const RobotModel& robot)
    : parameters_(parameters),
      max_position_error_(MarginBudget::of(robot).tracking()),
      max_speed_(robot.limits.max_speed),
      lag_s_(robot.actuator_lag_s),
      lead_s_(robot.actuator_lag_s + parameters.command_delay_s),
      braking_(robot.braking()),
      catch_up_acceleration_(robot.max_wheel_acceleration),
      limiter_(robot) {
  require_positive(max_position_error_.still_m, "margin_tracking_still");
  require_positive(parameters.max_heading_error_rad, "max_heading_error");
  require_positive(parameters.max_pose_age_s, "max_pose_age");
  set_gains(parameters.gains);
}

void TrajectoryTracker::set_gains(const FeedbackGains& gains) {
  require_positive(gains.along, "along_gain");
  require_positive(gains.across, "across_gain");
  require_positive(gains.heading, "heading_gain");
  require_positive(gains.max_bandwidth, "max_bandwidth");
  parameters_.gains = gains;
}

void TrajectoryTracker::offer(const MotionId& id, Motion motion, double lease_end_s) {
  const auto outdated = [&id](const CommitmentProtocol& known) {
    return !known.motion.empty() && known.id.epoch == id.epoch && known.id.sequence >= id.sequence;
  };
  if (outdated(active_) || (offer_ && outdated(*offer_))) return;
  if (early_lease_ && early_lease_->id == id) lease_end_s = early_lease_->lease_end_s;
  offer_ = CommitmentProtocol{id, std::move(motion), lease_end_s};
}

void TrajectoryTracker::renew(const MotionId& id, double lease_end_s) {
  if (offer_ && offer_->id == id) {
    offer_->lease_end_s = lease_end_s;
  } else if (!active_.motion.empty() && active_.id == id) {
    active_.lease_end_s = lease_end_s;
  } else {
    early_lease_ = CommitmentProtocol{id, Motion(), lease_end_s};
  }
}

void TrajectoryTracker::set_stopped(bool stopped, const std::string& reason) {
  if (stopped_ && !stopped) {
    offer_.reset();
    early_lease_.reset();
  }
  stopped_ = stopped;
  order_ = reason;
}

UnicycleState TrajectoryTracker::step(double t, const std::optional<RobotState>& state) {
  const double dt =
      last_step_s_ ? std::clamp(t - *last_step_s_, 0.0, kLongestStep_s) : kFirstStep_s;
  last_step_s_ = t;
  std::optional<Pose> pose;
  if (state && std::abs(t - state->stamp_s) <= parameters_.max_pose_age_s)
    pose = predict(*state, t);

  if (offer_ && pose && offer_->lease_end_s > t) take_up_offer(t, *pose, state->twist.speed);
  update_mode(t, pose);
  handle(stopped_ ? TrackerEvent::kStopped : TrackerEvent::kReset, t, order_);
  switch (mode_) {
    case TrackerMode::kIdle:
    case TrackerMode::kEmergency:
      return limiter_.limit({0.0, 0.0}, dt);  // both wheels in the same ratio
    case TrackerMode::kErrorBraking:
      return limiter_.ramp_down_straight(dt);
    case TrackerMode::kStale:
      return limiter_.ramp_down(dt);
    default:
      return limiter_.limit(wanted(t, *pose), dt);
  }
}

void TrajectoryTracker::take_up_offer(double t, const Pose& pose, double speed) {
  CommitmentProtocol next = *std::exchange(offer_, std::nullopt);
  std::string why;
  if (next.motion.start_time() > t) {
    const MotionState start = next.motion.at(next.motion.start_time());
    const bool turns = start.velocity.isZero() && !start.at_rest;
    if (start.velocity.norm() > kRestSpeed || turns) {
      why = format("it starts %.2f s from now, already at %.2f m/s and %.2f rad/s",
                   next.motion.start_time() - t, start.speed, start.yaw_rate);
    }
    if (!active_.motion.empty()) {
      MotionOrFault joined = splice(active_.motion, t, next.motion.start_time(), next.motion);
      // Where it is no continuation, it has to start from rest, where the robot stands.
      if (joined) {
        next.motion = std::move(joined.motion);
        why.clear();
      }
    }
  }
  const MotionState reference = next.motion.at(t);
  const TrackingError error = tracking_error(pose, reference.pose);
  if (why.empty()) why = misfit(error, reference);
  if (why.empty()) why = too_fast(error, speed, reference);
  if (!why.empty()) {
    ++refused_;
    refusal_ = format("motion %u/%u does not fit the robot: %s", next.id.epoch, next.id.sequence,
                      why.c_str());
    return;
  }
  active_ = std::move(next);
  ++motions_;
  handle(TrackerEvent::kAdopted, t, "");
}

/// The bound at the highest speed holds for a robot that stands: the error moves it nowhere, and
/// the next motion is held against its own bound as it sets off.
double TrajectoryTracker::allowed_m(const MotionState& reference) const {
  return max_position_error_.at(reference.at_rest ? max_speed_ : std::abs(reference.speed));
}

std::string TrajectoryTracker::misfit(const TrackingError& error,
                                      const MotionState& reference) const {
  if (error.position_m() > allowed_m(reference)) {
    return format("%.2f m off the path's pose (%.2f along, %.2f across), allowed %.3f m",
                  error.position_m(), error.along_m, error.across_m, allowed_m(reference));
  }
  if (std::abs(error.heading_rad) > parameters_.max_heading_error_rad) {
    return format("heading off by %.2f rad, allowed %.2f rad", error.heading_rad,
                  parameters_.max_heading_error_rad);
  }
  return "";
}

/// A robot that first has to catch up in speed falls behind; this says so if it would fall out of
/// the error bound.
std::string TrajectoryTracker::too_fast(const TrackingError& error, double speed,
                                        const MotionState& reference) const {
  const double gap = std::abs(reference.speed - speed);
  const double lost = gap * (lag_s_ + 0.5 * gap / catch_up_acceleration_);
  if (error.position_m() + lost <= allowed_m(reference)) return "";
  return format("it moves at %.2f m/s, the robot at %.2f m/s", reference.speed, speed);
}

/// At rest now and when a command of now takes effect.
bool TrajectoryTracker::stands(double t) const {
  return active_.motion.at(t).at_rest && active_.motion.at(t + lead_s_).at_rest;
}

void TrajectoryTracker::update_mode(double t, const std::optional<Pose>& pose) {
  error_.reset();
  if (active_.motion.empty()) return;
  // Before the pose may come back: a robot that stopped blind does not set off under an expired
  // lease.
  if (t > active_.lease_end_s && !stands(t)) {
    handle(TrackerEvent::kLeaseExpired, t,
           format("the lease ended %.2f s ago", t - active_.lease_end_s));
  }
  if (!pose) {
    handle(TrackerEvent::kPoseLost, t, format("no pose for %.2f s", parameters_.max_pose_age_s));
    return;
  }
  handle(TrackerEvent::kPoseBack, t, "");
  const MotionState reference = active_.motion.at(t);
  error_ = tracking_error(*pose, reference.pose);
  const std::string strayed = misfit(*error_, reference);
  if (!strayed.empty()) handle(TrackerEvent::kStrayed, t, strayed);
  if (t >= active_.motion.end_time()) handle(TrackerEvent::kArrived, t, stop_reason_);
}

void TrajectoryTracker::handle(TrackerEvent event, double t, const std::string& reason) {
  const TrackerMode next = next_mode(mode_, event);
  if (next == mode_) return;
  if (next == TrackerMode::kBraking) {
    active_.motion = stop_at_lease_end(active_.motion, active_.lease_end_s, t, braking_);
    ++motions_;
  }
  mode_ = next;
  stop_reason_ = reason;
}

UnicycleState TrajectoryTracker::wanted(double t, const Pose& pose) {
  const MotionState reference = active_.motion.at(t);
  if (stands(t)) {
    return {0.0, settling_yaw_rate(wrap_angle(reference.pose.yaw_rad - pose.yaw_rad))};
  }
  settling_rad_ = 0.0;
  settle_widening_ = 1.0;
  const MotionState ahead = active_.motion.at(t + lead_s_);
  return feedback(pose, reference.pose, {ahead.speed, ahead.yaw_rate}, parameters_.gains);
}

/// With a dead band, so that noise does not make a standing robot wiggle. Wheels that leap as they
/// break loose turn it too far: that ends the correction, too, and widens the band, as it would
/// hunt otherwise.
double TrajectoryTracker::settling_yaw_rate(double heading_error_rad) {
  const FeedbackGains& gains = parameters_.gains;
  const bool settles = settling_rad_ != 0.0;
  const bool crossed = settling_rad_ * heading_error_rad < 0.0;
  if (crossed) settle_widening_ *= 2.0;
  const double bound =
      settles && !crossed ? gains.settle_stop_rad : settle_widening_ * gains.settle_start_rad;
  settling_rad_ = std::abs(heading_error_rad) > bound ? heading_error_rad : 0.0;
  return gains.heading * settling_rad_;
}

}  // namespace mocha
