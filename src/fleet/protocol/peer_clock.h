#pragma once

#include <optional>

#include "fleet/protocol/clock_estimate.h"

namespace mocha {

/// By which clock the promises of a peer are told: one that is ahead of ours by what was measured,
/// or not at all where that is as good. It is wrong by whatever the measurement leaves open, and
/// by what two clocks drift.
class PeerClock {
 public:
  /// An exchange, as ClockEstimate::add() takes it. Returns by how much later the promises are to
  /// be told from now on; mostly 0. Errors up to the tolerance are not worth a correction.
  double add(double sent_s, double held_s, double stamp_s, double tolerance_s, double now);

  std::optional<ClockReading> reading(double now) const { return estimate_.reading(now); }

  double ahead_s() const { return ahead_s_; }
  /// By how much the clock may be wrong, at a time that may lie ahead; none: nothing is known.
  std::optional<double> error_s(double now) const;
  /// How much more that is than the tolerance, for which margins allow; 0 where it is less, or
  /// where nothing is known.
  double mistimed_s(double tolerance_s, double now) const;

 private:
  friend class ProtocolFingerprint;  // of test/fleet/model

  ClockEstimate estimate_;
  double ahead_s_ = 0.0;
};

}  // namespace mocha
