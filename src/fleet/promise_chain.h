#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "fleet/promise.h"

namespace mocha {

/// A stretch of a robot's future: from `from_s` until `until_s` (absolute) it moves as `promise`
/// says.
struct Claim {
  Promise promise;
  double from_s = -std::numeric_limits<double>::infinity();
  double until_s = std::numeric_limits<double>::infinity();
};

/// The claim of a proposal: everything from its start on.
Claim claim_of(const Promise& proposal);

/// Two claims come closer than allowed.
struct Conflict {
  std::string peer;
  double time_s = 0.0;              ///< absolute, the first moment
  double distance_m = 0.0;          ///< centre to centre, the smallest from then on
  double required_m = 0.0;          ///< what is demanded
  Vector2 place = Vector2::Zero();  ///< [m] of the own robot at the first moment, map frame
};

/// The first moment from `now` on at which both claims hold and the centres are closer than
/// `required_m`.
std::optional<Conflict> first_conflict(const Claim& mine, const Claim& theirs, double required_m,
                                       double now);

/// The binding promises of one robot that matter from now on. Each holds from its start until the
/// next one starts; so between being settled and being driven, a motion has its predecessor in
/// force.
class PromiseChain {
 public:
  /// The promise replaces everything from its start on. Its motion must not be empty.
  void bind(Promise promise);

  /// See reclocked().
  void reclock(double later_s, double less_sure_s);

  /// Forgets what has been replaced by time `now`.
  void prune(double now);

  bool empty() const { return claims_.empty(); }
  /// The promise bound last; the chain must not be empty.
  const Promise& newest() const { return claims_.back().promise; }
  /// In order of time, without gaps; from the first one's start backward the robot stands there.
  const std::vector<Claim>& claims() const { return claims_; }
  /// Where the robot is at time t; the chain must not be empty.
  Vector2 position(double t) const;
  /// What the robot does from `now` on, as one motion; the chain must not be empty. Where the parts
  /// do not join (it was set down elsewhere, or brakes off its motion) this is the newest one
  /// alone.
  std::shared_ptr<const Motion> composed(double now) const;

 private:
  void join();

  std::vector<Claim> claims_;  // by start, which is also by number
};

}  // namespace mocha
