#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "fleet/protocol/committed_trajectory.h"

namespace mocha {

/// A stretch of a robot's future: from `from_s` until `until_s` (absolute) it moves as `promise`
/// says.
struct Reservation {
  CommittedTrajectory trajectory;
  double from_s = -std::numeric_limits<double>::infinity();
  double until_s = std::numeric_limits<double>::infinity();
};

/// The reservation of a proposal: everything from its start on.
Reservation reservation_of(const CommittedTrajectory& proposal);

/// Two reservations come closer than allowed.
struct Conflict {
  std::string peer;
  double time_s = 0.0;              ///< absolute, the first moment
  double distance_m = 0.0;          ///< centre to centre, the smallest from then on
  double required_m = 0.0;          ///< what is demanded
  Vector2 place = Vector2::Zero();  ///< [m] of the own robot at the first moment, map frame
  bool by_stopping = false;         ///< where one of them brakes, at time_s or before
};

/// The first moment from `now` on at which both reservations hold and the centres are closer than
/// `required_m`.
std::optional<Conflict> first_conflict(const Reservation& mine, const Reservation& theirs,
                                       double required_m, double now);

/// The binding promises of one robot that matter from now on. Each holds from its start until the
/// next one starts; so between being settled and being driven, a motion has its predecessor in
/// force.
class ReservationChain {
 public:
  /// The promise replaces everything from its start on, but for promises of higher numbers: one
  /// that comes late goes before those. False where these replaced it before it began. Its motion
  /// must not be empty.
  bool bind(CommittedTrajectory trajectory);

  /// See reclocked().
  void reclock(double later_s);

  /// Forgets what has been replaced by time `now`.
  void prune(double now);

  bool holds(TrajectoryId id) const;
  bool empty() const { return reservations_.empty(); }
  /// The promise bound last; the chain must not be empty.
  const CommittedTrajectory& newest() const { return reservations_.back().trajectory; }
  /// In order of time, without gaps; from the first one's start backward the robot stands there.
  const std::vector<Reservation>& reservations() const { return reservations_; }
  /// Where the robot is at time t; the chain must not be empty.
  Vector2 position(double t) const;
  /// What the robot does from `now` on, in as few claims as can say it, in order of time; the chain
  /// must not be empty. Mostly one. Where promises do not join (the robot was set down elsewhere,
  /// or brakes off its motion) a new claim begins. Its motion takes over at `from_s` and not
  /// before: until then the one before it is in force, and is given whole, to its own rest.
  std::vector<Reservation> parts(double now) const;
  /// Holds every place of these from `now` on [m].
  Eigen::AlignedBox2d box(double now) const;
  /// The motion of the last of these: what is in force, or will be once the robot leaves what it
  /// drives now.
  std::shared_ptr<const Motion> composed(double now) const;

 private:
  friend class ProtocolFingerprint;  // of test/fleet/model

  void join();

  std::vector<Reservation> reservations_;  // by start, which is also by number
};

}  // namespace mocha
