#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "trajectory/braking.h"
#include "trajectory/motion.h"

namespace mocha {

/// The numbers are those of mocha_ugv/Trajectory.
enum class TrajectoryState : std::uint8_t {
  kProposed = 1,   ///< offered; not binding yet
  kCommitted = 2,  ///< binding: the robot drives this and nothing else
  kEmergency = 3,  ///< binding at once, without settling: braking, or swerving
  kWithdrawn = 4,  ///< the proposal of this number is void
};

inline bool is_binding(TrajectoryState state) {
  return state == TrajectoryState::kCommitted || state == TrajectoryState::kEmergency;
}

/// Which promise of one robot: the epoch counts its starts, the sequence its motions since the
/// start, from 1.
struct TrajectoryId {
  std::uint32_t epoch = 0;
  std::uint32_t sequence = 0;

  bool operator<(const TrajectoryId& other) const {
    return std::tie(epoch, sequence) < std::tie(other.epoch, other.sequence);
  }
  bool operator==(const TrajectoryId& other) const {
    return epoch == other.epoch && sequence == other.sequence;
  }
};

/// What a robot says about one motion.
struct CommittedTrajectory {
  std::string agent;
  TrajectoryId id;
  TrajectoryState state = TrajectoryState::kProposed;
  int priority = 0;
  double footprint_radius_m = 0.0;       ///< circumscribed, about the position of the motion
  std::optional<Braking> braking;        ///< along the motion, in good time; none where withdrawn
  std::shared_ptr<const Motion> motion;  ///< none where withdrawn
  /// Of a peer, as the planners hear of it: it may be early or late by so much.
  double mistimed_s = 0.0;
};

/// Whether a wins where two proposals meet: the higher priority, then the smaller name. A total
/// order over the fleet.
inline bool takes_precedence(const CommittedTrajectory& a, const CommittedTrajectory& b) {
  return a.priority != b.priority ? a.priority > b.priority : a.agent < b.agent;
}

/// Throws std::invalid_argument, saying what is wrong, for a promise that no robot can have meant:
/// no name, a sequence of 0, a radius outside (0, 10] m, and unless withdrawn no braking or motion,
/// a motion longer than five minutes, one that may exceed 50 m/s or 500 m/s^2, or from which the
/// robot may take more than two minutes to stop.
void validate(const CommittedTrajectory& trajectory);

/// The same for braking that no robot can have: a deceleration, or a finite limit of the
/// acceleration, outside [0.02, 50] m/s^2.
void validate(const Braking& braking);

/// The promise by a clock that shows `later_s` more.
CommittedTrajectory reclocked(CommittedTrajectory trajectory, double later_s);

/// One line of a heartbeat: the newest promise of `agent` that the sender has seen and does not
/// object to.
struct Acknowledgement {
  std::string agent;
  TrajectoryId id;
  TrajectoryState state = TrajectoryState::kProposed;
};

/// Another line: the sender heard the heartbeat of `agent` that is stamped so, and held_s later
/// sent its own.
struct Echo {
  std::string agent;
  double stamp_s = 0.0;  ///< of the clock of `agent`
  double held_s = 0.0;
};

/// "I live, and this is what I have seen of you." About the sender itself it lists its newest
/// binding promise and, if it came later, its newest proposal (or the withdrawal of it).
struct Heartbeat {
  std::string agent;
  std::uint32_t epoch = 0;
  double stamp_s = 0.0;  ///< of the sender's clock
  std::vector<Acknowledgement> acknowledgements;
  std::vector<Echo> echoes;
  double promise_reach_m = 0.0;  ///< from where it is, the sender promises no farther
};

}  // namespace mocha
