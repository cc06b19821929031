#include "trajectory/motion.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "trajectory/arc_length.h"
#include "trajectory/piece_hull.h"
#include "trajectory/unicycle.h"

namespace mocha {
namespace {

constexpr double kRestSpeed = 1e-4;    // [m/s] slower is rest
constexpr double kRestYawRate = 1e-4;  // [rad/s] the same of turns
constexpr double kLeastSpeed =
    1e-6;  // [m/s] below, the direction of the velocity is rounding noise
constexpr double kRestAcceleration = 1e-3;  // [m/s^2] likewise
constexpr double kRestJerk = 1e-3;          // [m/s^3] likewise
constexpr double kLargest = 1e12;           // [m], [m/s^2] beyond, squares soon overflow
constexpr double kSameYawRate = 0.01;       // [rad/s]
constexpr double kSliverOfMotion_s = 2e-3;
constexpr double kShortestPhase_s = 1e-5;  // shorter parts of a phase are dropped when cutting

MotionState state_in(const TurnPhase& turn, double t) {
  const TurnState at = state_of(turn, t);
  MotionState state;
  state.pose = {turn.start.position, at.yaw_rad};
  state.yaw_rate = at.rates.yaw_rate;
  state.at_rest = std::abs(state.yaw_rate) < kRestYawRate;
  return state;
}

MotionState state_in(const DrivePhase& drive, double t) {
  const auto at = drive.path.locate(t);
  MotionState state;
  state.pose.position = drive.path.derivative(at, 0);
  state.pose.yaw_rad = heading(drive, t);
  state.velocity = drive.path.derivative(at, 1);
  state.acceleration = drive.path.derivative(at, 2);
  const UnicycleState body =
      unicycle_state(drive.direction, state.velocity, state.acceleration,
                     drive.path.derivative(at, 3), drive.path.derivative(at, 4));
  state.speed = body.speed;
  state.yaw_rate = body.yaw_rate;
  state.at_rest = state.velocity.norm() < kRestSpeed;
  return state;
}

MotionState state_in(const StandPhase& stand, double) {
  MotionState state;
  state.pose = stand.pose;
  return state;
}

MotionState state_in(const Phase& phase, double t) {
  return std::visit([t](const auto& each) { return state_in(each, t); }, phase);
}

/// The same state with all motion taken out: before the start and after the end a robot stands.
MotionState standing(const MotionState& state) {
  MotionState still;
  still.pose = state.pose;
  return still;
}

bool finite(const MotionState& state) {
  return state.pose.position.allFinite() && std::isfinite(state.pose.yaw_rad) &&
         std::isfinite(state.yaw_rate) && state.velocity.allFinite() &&
         state.acceleration.allFinite();
}

/// Whether a path is; `box` is made to hold it.
bool finite(const PlanarPath& path, Eigen::AlignedBox2d& box) {
  for (int i = 0; i < path.pieces(); ++i) {
    const auto hull = piece_hull(path.piece(i), path.piece_duration(i));
    for (int j = 0; j < hull.position.cols(); ++j) {
      if (!(hull.position.col(j).norm() < kLargest)) return false;
      box.extend(hull.position.col(j));
    }
    for (int j = 0; j < hull.acceleration.cols(); ++j) {
      if (!(hull.acceleration.col(j).norm() < kLargest)) return false;
    }
  }
  return true;
}

/// The yaw rate of a turn in place at its ends [rad/s]; 0 of anything else.
double turned_at_start(const Phase& phase) {
  const auto* turn = std::get_if<TurnPhase>(&phase);
  return turn != nullptr ? turn->from.yaw_rate : 0.0;
}
double turned_at_end(const Phase& phase) {
  const auto* turn = std::get_if<TurnPhase>(&phase);
  return turn != nullptr ? turn->to.yaw_rate : 0.0;
}

void require(bool condition, const std::string& what) {
  if (!condition) throw std::invalid_argument("Motion: " + what);
}

}  // namespace

double wrap_angle(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2.0 * M_PI);
  return wrapped <= -M_PI ? M_PI : wrapped;
}

double duration_s(const Phase& phase) {
  if (const auto* drive = std::get_if<DrivePhase>(&phase)) return drive->path.duration();
  if (const auto* turn = std::get_if<TurnPhase>(&phase)) return turn->duration_s;
  return std::get<StandPhase>(phase).duration_s;
}

double heading(const DrivePhase& drive, double t) {
  const auto at = drive.path.locate(t);
  Vector2 along = drive.path.derivative(at, 1);
  if (along.norm() < kLeastSpeed) {
    // At rest the heading is the limit of the velocity's direction from inside the phase.
    const double side = t < 0.5 * drive.path.duration() ? 1.0 : -1.0;
    along = side * drive.path.derivative(at, 2);
    if (along.norm() < kRestAcceleration) along = drive.path.derivative(at, 3);
    if (along.norm() < kRestJerk) along = side * drive.path.derivative(at, 4);
  }
  return std::atan2(drive.direction * along.y(), drive.direction * along.x());
}

const char* describe(MotionFault fault) {
  switch (fault) {
    case MotionFault::kNone:
      return "is a motion";
    case MotionFault::kStartTime:
      return "the start time is not finite";
    case MotionFault::kNoPhases:
      return "has no phases";
    case MotionFault::kDirection:
      return "a drive's direction is not +1 or -1";
    case MotionFault::kOutOfRange:
      return "a drive is empty, not finite, or beyond 1e12 m or m/s^2";
    case MotionFault::kDuration:
      return "a duration is negative or not finite";
    case MotionFault::kNotFinite:
      return "a phase is not finite";
    case MotionFault::kPositionJump:
      return "jumps in position between phases";
    case MotionFault::kHeadingJump:
      return "jumps in heading between phases";
    case MotionFault::kVelocityJump:
      return "jumps in velocity between phases";
    case MotionFault::kYawRateJump:
      return "jumps in yaw rate where a turn in place begins or ends";
    case MotionFault::kMoves:
      return "does not end at rest";
  }
  return "unknown";
}

Motion::Motion(double start_time_s, std::vector<Phase> phases)
    : start_time_s_(start_time_s), phases_(std::move(phases)) {
  const MotionFault fault = index();
  require(fault == MotionFault::kNone, describe(fault));
}

MotionOrFault Motion::make(double start_time_s, std::vector<Phase> phases) {
  MotionOrFault made;
  made.motion.start_time_s_ = start_time_s;
  made.motion.phases_ = std::move(phases);
  made.fault = made.motion.index();
  if (made.fault != MotionFault::kNone) made.motion = Motion();
  return made;
}

/// Fills in what is kept about the phases, as far as they make a motion.
MotionFault Motion::index() {
  if (!std::isfinite(start_time_s_)) return MotionFault::kStartTime;
  if (phases_.empty()) return MotionFault::kNoPhases;
  phase_starts_.push_back(start_time_s_);
  for (std::size_t i = 0; i < phases_.size(); ++i) {
    const MotionFault fault = index_phase(i);
    if (fault != MotionFault::kNone) return fault;
    phase_starts_.push_back(phase_starts_.back() + mocha::duration_s(phases_[i]));
  }
  const MotionState end = state_in(phases_.back(), mocha::duration_s(phases_.back()));
  const bool rests =
      end.velocity.norm() <= 1e-3 && std::abs(turned_at_end(phases_.back())) <= kSameYawRate;
  return rests ? MotionFault::kNone : MotionFault::kMoves;
}

MotionFault Motion::index_phase(std::size_t i) {
  const Phase& phase = phases_[i];
  const double duration = mocha::duration_s(phase);
  if (const auto* drive = std::get_if<DrivePhase>(&phase)) {
    if (drive->direction != 1 && drive->direction != -1) return MotionFault::kDirection;
    if (drive->path.pieces() == 0 || !finite(drive->path, box_)) return MotionFault::kOutOfRange;
  }
  if (!std::isfinite(duration) || duration < 0.0) return MotionFault::kDuration;
  const MotionState begin = state_in(phase, 0.0);
  const MotionState end = state_in(phase, duration);
  if (!finite(begin) || !finite(end)) return MotionFault::kNotFinite;
  box_.extend(begin.pose.position).extend(end.pose.position);
  if (i == 0) return MotionFault::kNone;
  const MotionState before = state_in(phases_[i - 1], mocha::duration_s(phases_[i - 1]));
  if ((before.pose.position - begin.pose.position).norm() > 1e-3) return MotionFault::kPositionJump;
  if (std::abs(wrap_angle(before.pose.yaw_rad - begin.pose.yaw_rad)) > 0.01)
    return MotionFault::kHeadingJump;
  if ((before.velocity - begin.velocity).norm() > 0.01) return MotionFault::kVelocityJump;
  return std::abs(turned_at_end(phases_[i - 1]) - turned_at_start(phase)) <= kSameYawRate
             ? MotionFault::kNone
             : MotionFault::kYawRateJump;
}

double Motion::end_time() const { return phases_.empty() ? start_time_s_ : phase_starts_.back(); }

int Motion::phase_at(double t) const {
  const auto next = std::upper_bound(phase_starts_.begin(), phase_starts_.end(), t);
  const int index = static_cast<int>(next - phase_starts_.begin()) - 1;
  return std::clamp(index, 0, static_cast<int>(phases_.size()) - 1);
}

MotionState Motion::at(double t) const {
  require(!phases_.empty(), "at() of an empty motion");
  const int i = phase_at(t);
  const MotionState state = state_in(phases_[i], t - phase_starts_[i]);
  return t < start_time_s_ || t >= end_time() ? standing(state) : state;
}

Vector2 Motion::position(double t) const {
  require(!phases_.empty(), "position() of an empty motion");
  const int i = phase_at(t);
  if (const auto* turn = std::get_if<TurnPhase>(&phases_[i])) return turn->start.position;
  if (const auto* stand = std::get_if<StandPhase>(&phases_[i])) return stand->pose.position;
  const PlanarPath& path = std::get<DrivePhase>(phases_[i]).path;
  return path.derivative(path.locate(t - phase_starts_[i]), 0);
}

Vector2 Motion::velocity(double t) const {
  require(!phases_.empty(), "velocity() of an empty motion");
  const int i = phase_at(t);
  const auto* drive = std::get_if<DrivePhase>(&phases_[i]);
  if (drive == nullptr || t < start_time_s_ || t >= end_time()) return Vector2::Zero();
  return drive->path.derivative(drive->path.locate(t - phase_starts_[i]), 1);
}

Pose Motion::end_pose() const { return at(end_time()).pose; }

double Motion::length_m() const {
  double length = 0.0;
  for (const Phase& phase : phases_) {
    if (const auto* drive = std::get_if<DrivePhase>(&phase)) length += arc_length(drive->path);
  }
  return length;
}

double Motion::switch_time(double t) const {
  if (phases_.empty() || t <= start_time_s_) return t;
  for (int i = phase_at(t); t < end_time(); ++i) {
    const bool turns = std::holds_alternative<TurnPhase>(phases_[i]);
    if (!turns || (t - phase_starts_[i] <= kShortestPhase_s && turned_at_start(phases_[i]) == 0.0))
      return t;
    t = phase_starts_[i + 1];
  }
  return t;
}

double Motion::clean_cut(double t) const {
  for (const double boundary : phase_starts_) {
    if (std::abs(t - boundary) < kSliverOfMotion_s) return boundary;
  }
  return t;
}

std::vector<Phase> Motion::phases_between(double t0, double t1) const {
  std::vector<Phase> parts;
  for (int i = 0; i < static_cast<int>(phases_.size()); ++i) {
    const double begin = phase_starts_[i];
    // Absolute times are coarse: a whole phase is asked for by its end, not by a difference of two
    // large numbers.
    const double whole = mocha::duration_s(phases_[i]);
    const double from = std::max(0.0, t0 - begin);
    const double to = t1 >= phase_starts_[i + 1] ? whole : std::min(t1 - begin, whole);
    if (to - from < kShortestPhase_s) continue;
    if (const auto* drive = std::get_if<DrivePhase>(&phases_[i])) {
      parts.push_back(DrivePhase{drive->direction, drive->path.slice(from, to)});
    } else if (const auto* stand = std::get_if<StandPhase>(&phases_[i])) {
      parts.push_back(StandPhase{stand->pose, to - from});
    } else {
      const auto& turn = std::get<TurnPhase>(phases_[i]);
      const bool all = to - from > whole - 2.0 * kShortestPhase_s;
      parts.push_back(all ? turn : part_of(turn, from, to));
    }
  }
  return parts;
}

}  // namespace mocha
