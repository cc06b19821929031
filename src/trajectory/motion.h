#pragma once

#include <Eigen/Geometry>
#include <variant>
#include <vector>

#include "trajectory/piecewise_polynomial.h"
#include "trajectory/turn_phase.h"

namespace mocha {

/// Drive along a polynomial; the heading is that of the velocity (direction +1) or its opposite
/// (-1).
struct DrivePhase {
  int direction;
  PlanarPath path;
};

struct StandPhase {
  Pose pose;
  double duration_s;
};

using Phase = std::variant<TurnPhase, DrivePhase, StandPhase>;

double duration_s(const Phase& phase);

/// Where a robot on a motion is at one time, and how it moves. Map frame.
struct MotionState {
  Pose pose;
  Vector2 velocity = Vector2::Zero();      ///< [m/s]
  Vector2 acceleration = Vector2::Zero();  ///< [m/s^2]
  double speed = 0.0;     ///< [m/s] along the heading; negative when driving backward
  double yaw_rate = 0.0;  ///< [rad/s]
  bool at_rest = true;    ///< not moving and not in the middle of a turn
};

/// Why phases make no motion.
enum class MotionFault {
  kNone,
  kStartTime,  ///< the start time is not finite
  kNoPhases,
  kDirection,     ///< a drive's direction is not +1 or -1
  kOutOfRange,    ///< a drive is empty, not finite, or beyond 1e12 m or m/s^2
  kDuration,      ///< a duration is negative or not finite
  kNotFinite,     ///< where a phase begins or ends
  kPositionJump,  ///< of more than 1 mm between phases
  kHeadingJump,   ///< of more than 0.01 rad between phases
  kVelocityJump,  ///< of more than 0.01 m/s between phases
  kYawRateJump,   ///< of a turn in place, of more than 0.01 rad/s where it begins or ends
  kMoves,         ///< does not end at rest
};

/// In words.
const char* describe(MotionFault fault);

struct MotionOrFault;

/// What a robot does from start_time_s on: phases without gaps; before the first it stands at the
/// start, after the last it stands at the end.
class Motion {
 public:
  Motion() = default;
  /// Throws std::invalid_argument without phases, with values that are not finite (or positions and
  /// accelerations of a drive beyond 1e12), with a jump between phases (more than 1 mm, 0.01 rad,
  /// 0.01 m/s or, in turns, 0.01 rad/s), or if the motion does not end at rest.
  Motion(double start_time_s, std::vector<Phase> phases);

  /// The same without throwing; where the phases make no motion, it is empty and the fault says
  /// why.
  static MotionOrFault make(double start_time_s, std::vector<Phase> phases);

  bool empty() const { return phases_.empty(); }
  double start_time() const { return start_time_s_; }
  double end_time() const;
  const std::vector<Phase>& phases() const { return phases_; }
  double phase_start_time(int i) const { return phase_starts_[i]; }

  /// State at absolute time t [s].
  MotionState at(double t) const;
  /// The same position and velocity, several times faster, as a heading costs more than a place.
  Vector2 position(double t) const;
  Vector2 velocity(double t) const;
  Pose end_pose() const;
  double length_m() const;
  /// Holds every place that the motion comes to [m]; a little more than is needed.
  const Eigen::AlignedBox2d& box() const { return box_; }

  /// Which of the phases is under way at absolute time t; the first before all, the last after all.
  int phase_at(double t) const;

  /// The first time >= t at which no turn in place is under way: t itself while driving or
  /// standing, else the end of the turn.
  double switch_time(double t) const;

  /// t, or the boundary between two phases that is less than 2 ms away: what a cut at t would leave
  /// of a phase is too short to be told in the numbers of a message.
  double clean_cut(double t) const;

  /// The phases between absolute times t0 and t1 (clamped); empty where t1 <= t0. Used to compose
  /// motions.
  std::vector<Phase> phases_between(double t0, double t1) const;

 private:
  MotionFault index();
  MotionFault index_phase(std::size_t i);

  double start_time_s_ = 0.0;
  std::vector<Phase> phases_;
  std::vector<double> phase_starts_;  // absolute; one more than phases
  Eigen::AlignedBox2d box_;
};

struct MotionOrFault {
  Motion motion;
  MotionFault fault = MotionFault::kNone;

  explicit operator bool() const { return fault == MotionFault::kNone; }
};

/// Heading of a drive phase at time t within it; continuous through points of rest at its ends.
double heading(const DrivePhase& drive, double t);

}  // namespace mocha
