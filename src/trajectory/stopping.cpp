#include "trajectory/stopping.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "trajectory/minco.h"

namespace mocha {
namespace {

constexpr double kRestTurn = 1e-4;  // [rad/s] the same of a turn in place
constexpr double kNoTurn = 0.05;    // [rad/s] of a robot that stands, as it is measured
constexpr double kKnotSpacing_s = 0.2;
constexpr double kStand_s = 0.1;
constexpr double kSliver_s = 2e-3;  // of a drive, before the braking: of no use

/// What a braking robot follows: states by the time at which the original motion has them, up to
/// where that ends.
struct BrakedTrack {
  std::function<MotionState(double)> at;
  std::function<double(double)> speed;  ///< never negative
  double start_s;
  double end_s;
};

/// The braking's own time against the track's, at equal steps; the last step is shorter.
struct Schedule {
  std::vector<double> track_s;
  double step_s;
  double duration_s;
  bool reaches_end;  ///< of the track: its own end comes first

  double track_time(double own_s) const {
    const int last = static_cast<int>(track_s.size()) - 2;
    const int i = std::clamp(static_cast<int>(own_s / step_s), 0, last);
    const double span = i == last ? duration_s - last * step_s : step_s;
    const double share = std::clamp((own_s - i * step_s) / span, 0.0, 1.0);
    return track_s[i] + share * (track_s[i + 1] - track_s[i]);
  }
};

/// The acceleration across the track where it is driven at `speed`, not faster than the track is.
double lateral(const BrakedTrack& track, double t, double speed) {
  const MotionState state = track.at(t);
  return std::abs(state.yaw_rate / state.speed) * speed * speed;
}

/// Slows down from the track's state at its start: a ramp to the deceleration, then that, but never
/// faster than the track at the same place (which may be slowing down for a bend).
Schedule slow_down(const BrakedTrack& track, const Braking& braking) {
  const double deceleration = braking.deceleration();
  const MotionState start = track.at(track.start_s);
  double speed = start.velocity.norm();
  const double acceleration = start.acceleration.dot(start.velocity) / speed;
  // The ramp leaves at least half of the speed to brake with.
  const double drop = std::max(deceleration - acceleration, 1e-3 * deceleration);
  const double ramp_s = std::min(kBrakingRamp_s, speed / drop);
  const double expected_s = ramp_s + speed / deceleration;
  Schedule schedule{{track.start_s}, std::min(0.01, expected_s / 64.0), 0.0, false};
  double t = track.start_s;
  for (int i = 0;; ++i) {
    const double ramped = std::min(1.0, (i + 0.5) * schedule.step_s / ramp_s);
    const double track_speed = track.speed(t);
    speed = std::min(speed, track_speed);
    const double rate = braking.rate(acceleration, ramped, lateral(track, t, speed));
    const double next_speed = speed + rate * schedule.step_s;
    const double step = next_speed > 0.0 ? schedule.step_s : -speed / rate;
    // Half a step ahead on the track, for its speed in the middle of the step.
    const double ahead = t + 0.5 * step * speed / track_speed;
    const double middle_speed = 0.5 * (speed + std::max(0.0, next_speed));
    t += step * std::min(1.0, middle_speed / track.speed(ahead));
    schedule.duration_s += step;
    if (!(t < track.end_s) || !(track.speed(t) > kRest_mps)) {
      schedule.reaches_end = true;
      return schedule;
    }
    schedule.track_s.push_back(t);
    if (next_speed <= 0.0) return schedule;
    speed = next_speed;
  }
}

DrivePhase drive_to_rest(const BrakedTrack& track, const Schedule& schedule, double deceleration) {
  const int pieces = std::max(1, static_cast<int>(std::ceil(schedule.duration_s / kKnotSpacing_s)));
  const double spacing = schedule.duration_s / pieces;
  PlanarMinco::Knots knots(2, pieces - 1);
  for (int k = 1; k < pieces; ++k) {
    knots.col(k - 1) = track.at(schedule.track_time(k * spacing)).pose.position;
  }
  const MotionState first = track.at(track.start_s);
  const MotionState last = track.at(schedule.track_s.back());
  PlanarMinco::State start;
  PlanarMinco::State end;
  start << first.pose.position, first.velocity, first.acceleration;
  // Ending on the deceleration, not on zero jerk: the heading at rest is then well defined.
  end << last.pose.position, Vector2::Zero(), -deceleration * last.velocity.normalized();
  PlanarMinco minco;
  minco.resize(pieces);
  minco.solve(start, end, knots, Eigen::VectorXd::Constant(pieces, spacing));
  return DrivePhase{first.speed < 0.0 ? -1 : 1, minco.curve()};
}

/// The end of the path that is being driven at t, through drives without rest between them; t
/// itself if none is.
double path_end(const Motion& motion, double t) {
  double end = t;
  for (int i = 0; i < static_cast<int>(motion.phases().size()); ++i) {
    const double phase_end = motion.phase_start_time(i) + duration_s(motion.phases()[i]);
    if (phase_end <= t) continue;
    const auto* drive = std::get_if<DrivePhase>(&motion.phases()[i]);
    if (drive == nullptr) return end;
    end = phase_end;
    if (drive->path.derivative(drive->path.duration(), 1).norm() < kRest_mps) return end;
  }
  return end;
}

/// The time at which the drive under way at t began, where that was from rest and it has hardly
/// moved since; else t. The direction of a crawl that is cut off says nothing about the heading.
double before_crawling(const Motion& motion, double t) {
  for (int i = 0; i < static_cast<int>(motion.phases().size()); ++i) {
    const double begin = motion.phase_start_time(i);
    const auto* drive = std::get_if<DrivePhase>(&motion.phases()[i]);
    if (drive == nullptr || t <= begin || t - begin >= 0.5 * drive->path.duration()) continue;
    const bool crawls = drive->path.derivative(0.0, 1).norm() < kRest_mps &&
                        drive->path.derivative(t - begin, 1).norm() < kRest_mps;
    if (crawls) return begin;
  }
  return t;
}

/// Returns how the turn in place that is under way at t comes to rest: braking, or by what is left
/// of it where that takes no longer. Nothing where no turn is under way.
std::optional<TurnPhase> end_of_turn(const Motion& motion, double t, const Braking& braking) {
  if (motion.at(t).at_rest) return std::nullopt;
  const int i = motion.phase_at(t);
  const auto* turn = std::get_if<TurnPhase>(&motion.phases()[i]);
  if (turn == nullptr) return std::nullopt;
  const TurnPhase left = part_of(*turn, t - motion.phase_start_time(i), turn->duration_s);
  const TurnPhase stop = turn_to_rest(left.start, left.from, braking.yaw_deceleration());
  return std::abs(left.to.yaw_rate) < kRestTurn && left.duration_s <= stop.duration_s ? left : stop;
}

/// A circle driven at constant speed, or a straight line.
MotionState on_circle(const Pose& pose, double speed, double yaw_rate, double t) {
  const double turned = yaw_rate * t;
  const double chord =
      std::abs(turned) < 1e-6 ? speed * t : 2.0 * speed / yaw_rate * std::sin(0.5 * turned);
  const double towards = pose.yaw_rad + 0.5 * turned;
  MotionState state;
  state.pose.yaw_rad = wrap_angle(pose.yaw_rad + turned);
  state.pose.position = pose.position + chord * Vector2(std::cos(towards), std::sin(towards));
  const Vector2 heading(std::cos(state.pose.yaw_rad), std::sin(state.pose.yaw_rad));
  state.velocity = speed * heading;
  state.acceleration = speed * yaw_rate * Vector2(-heading.y(), heading.x());
  state.speed = speed;
  state.yaw_rate = yaw_rate;
  state.at_rest = false;
  return state;
}

}  // namespace

std::vector<Phase> brake_along(const Motion& motion, double t, const Braking& braking) {
  const MotionState now = motion.at(t);
  if (const auto turning = end_of_turn(motion, t, braking)) return {*turning};
  if (now.velocity.norm() < kRest_mps) return {StandPhase{now.pose, kStand_s}};
  const BrakedTrack track{[&motion](double when) { return motion.at(when); },
                          [&motion](double when) { return motion.velocity(when).norm(); }, t,
                          path_end(motion, t)};
  const Schedule schedule = slow_down(track, braking);
  if (schedule.reaches_end) return motion.phases_between(t, track.end_s);
  return {drive_to_rest(track, schedule, braking.deceleration())};
}

std::vector<Phase> brake_from(const Pose& pose, double speed, double yaw_rate,
                              const Braking& braking) {
  if (std::abs(speed) < kRest_mps) {
    if (std::abs(yaw_rate) < kNoTurn) return {StandPhase{pose, kStand_s}};
    return {turn_to_rest(pose, {yaw_rate, 0.0}, braking.yaw_deceleration())};
  }
  const BrakedTrack track{[&](double t) { return on_circle(pose, speed, yaw_rate, t); },
                          [speed](double) { return std::abs(speed); }, 0.0,
                          std::numeric_limits<double>::infinity()};
  return {drive_to_rest(track, slow_down(track, braking), braking.deceleration())};
}

Motion with_brake(const Motion& motion, double t0, double t_brake, const Braking& braking) {
  MotionOrFault braked = try_brake(motion, t0, t_brake, braking);
  if (!braked) throw std::invalid_argument(std::string("with_brake: ") + describe(braked.fault));
  return std::move(braked.motion);
}

MotionOrFault try_brake(const Motion& motion, double t0, double t_brake, const Braking& braking) {
  const double start = std::max(t0, motion.start_time());
  t_brake = motion.clean_cut(before_crawling(motion, t_brake));
  if (t_brake > start && t_brake - start < kSliver_s) t_brake = start;
  std::vector<Phase> phases = motion.phases_between(start, t_brake);
  for (Phase& phase : brake_along(motion, t_brake, braking)) phases.push_back(std::move(phase));
  return Motion::make(start, std::move(phases));
}

}  // namespace mocha
