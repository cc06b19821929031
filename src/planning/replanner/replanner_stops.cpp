// The stops that are announced: what the robot does whatever it meets.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "fleet/wire/wire_format.h"
#include "planning/replanner/local_replanner.h"
#include "trajectory/splice.h"
#include "trajectory/stopping.h"
#include "trajectory/unicycle.h"

namespace mocha {
namespace {

constexpr double kStandPhase_s = 0.1;
constexpr double kShareOfError = 0.5;  // within which a stop is what was promised
constexpr double kSooner_s = 0.05;     // by less, a stop is no sooner than what is promised

/// Of an emergency stop [m/s^2], in which the faster wheel slows down as hard as it can.
double stop_deceleration(const UnicycleState& twist, const RobotModel& robot) {
  const WheelSpeeds wheels = wheel_speeds(twist, robot.limits.track_m);
  const double fastest = std::max(std::abs(wheels.left), std::abs(wheels.right));
  const double share = fastest > 0.0 ? std::abs(twist.speed) / fastest : 1.0;
  return std::max(robot.braking().deceleration(), share * robot.max_wheel_acceleration);
}

}  // namespace

void LocalReplanner::announce(double now_s, const Motion& motion, bool brakes, Row row,
                              Output& output) {
  output.row = row;
  try {
    output.proposal = proposals_.make(now_s, quantised(motion), true, {}, brakes);
  } catch (const std::invalid_argument& error) {
    output.reason = PlanReason::kInvalidInput;
    output.message = std::string("cannot be said to the others: ") + error.what();
  }
}

bool LocalReplanner::announced_stop(double now_s) const {
  return proposals_.pending(now_s) && proposals_.newest_brakes();
}

bool LocalReplanner::off_track(double now_s, const RobotState& measured) const {
  // A broadcaster that was started again only says what comes next; until then the tracker follows
  // what it has.
  if (now_s < committed_.start_time()) return false;
  const Pose promised = committed_.at(now_s).pose;
  return (promised.position - measured.pose.position).norm() > max_error_m(now_s) ||
         std::abs(wrap_angle(promised.yaw_rad - measured.pose.yaw_rad)) > options_.max_error_rad;
}

double LocalReplanner::max_error_m(double now_s) const {
  const MotionState promised = committed_.at(now_s);
  return promised.at_rest ? options_.max_standing_error_m
                          : options_.max_error.at(std::abs(promised.speed));
}

void LocalReplanner::stand_or_stop(double now_s, const RobotState& measured, Output& output) {
  if (!stands(measured)) {
    stop_here(now_s, measured, output);
    return;
  }
  // There is nothing to be settled about it: unless the others know, they drive through it.
  output.message = "promises to stand";
  announce(now_s, Motion(now_s, {StandPhase{measured.pose, kStandPhase_s}}), false, Row::kStand,
           output);
}

void LocalReplanner::stop_here(double now_s, const RobotState& measured, Output& output) {
  output.reason = PlanReason::kBraking;
  std::ostringstream text;
  text.precision(3);
  if (!committed_.empty()) {
    const double error_m = (committed_.at(now_s).pose.position - measured.pose.position).norm();
    text << "is " << error_m << " m off its promised motion (allowed: " << max_error_m(now_s)
         << " m): brakes from where it is";
  } else {
    text << "moves without a promise: brakes";
  }
  output.message = text.str();
  output.request_plan = true;
  const Motion stop(now_s, brake_from(measured.pose, measured.twist.speed, measured.twist.yaw_rate,
                                      robot_.braking()));
  announce(now_s, stop, true, Row::kStopHere, output);
}

std::optional<Motion> LocalReplanner::sooner_stop(double now_s) const {
  const bool stands = committed_.at(now_s).at_rest;
  const double brake_s = stands ? now_s : now_s + options_.emergency_s;
  const Motion stop = with_brake(committed_, now_s, brake_s, robot_.braking());
  const Motion& next = proposals_.pending(now_s) ? proposals_.newest() : committed_;
  if (stop.end_time() >= next.end_time() - kSooner_s) return std::nullopt;
  return rest_of(stop, brake_s);
}

LocalReplanner::Output LocalReplanner::stop_blind(double now_s) {
  Output output;
  output.row = Row::kStopBlind;
  if (committed_.empty()) return counted(output);
  if (const auto stop = sooner_stop(now_s)) announce(now_s, *stop, true, Row::kStopBlind, output);
  return counted(output);
}

LocalReplanner::Output LocalReplanner::halt(double now_s, const RobotState& state) {
  const Pose here = predict(state, now_s);
  Output output;
  output.row = Row::kEmergencyStop;
  output.reason = PlanReason::kEmergencyStop;
  offered_.reset();
  replace_plan(Motion());
  const Motion stop(now_s, brake_from(here, state.twist.speed, state.twist.yaw_rate,
                                      Braking(stop_deceleration(state.twist, robot_))));
  if (!announced_stop(now_s) && !is_promised(stop, now_s))
    announce(now_s, stop, true, Row::kEmergencyStop, output);
  return counted(output);
}

bool LocalReplanner::is_promised(const Motion& stop, double now_s) const {
  if (committed_.empty() || committed_.end_time() > stop.end_time()) return false;
  const Pose promised = committed_.at(now_s).pose;
  const Pose real = stop.at(now_s).pose;
  return (promised.position - real.position).norm() < kShareOfError * max_error_m(now_s) &&
         std::abs(wrap_angle(promised.yaw_rad - real.yaw_rad)) <
             kShareOfError * options_.max_error_rad;
}

}  // namespace mocha
