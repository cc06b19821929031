#pragma once

#include <optional>

namespace mocha {

/// What is known of a peer's clock: the offset (the peer's clock less ours) lies within
/// `uncertainty_s` of `offset_s`, however delays divide between there and back.
struct ClockReading {
  double offset_s = 0.0;
  double uncertainty_s = 0.0;
  double delay_s = 0.0;  ///< of a message these days, there and back halved
};

/// The highest of the lower bounds on a value that were told in the last half to whole minute. A
/// bound sinks as it gets older, as the value drifts.
class RecentBound {
 public:
  void add(double at_least, double now);
  std::optional<double> at(double now) const;

 private:
  struct Sample {
    double at_least;
    double time_s;
  };
  static double sunk(const Sample& sample, double now);
  static bool better(const Sample& a, const std::optional<Sample>& b, double now);

  std::optional<Sample> best_;    // since from_s_ less kMemory_s
  std::optional<Sample> recent_;  // since from_s_
  double from_s_ = 0.0;
};

/// Where a peer's clock stands against ours, from heartbeats that are echoed. A message shows how
/// far its sender's clock is ahead at least: it was not sent later than it came. So the fastest
/// message there and the fastest one back, be they of different exchanges, bound the offset on
/// both sides; nothing tells more, as the rest may be an offset or a delay.
///
/// An exchange that contradicts the bounds means that a clock was set; then it alone counts.
class ClockEstimate {
 public:
  static constexpr double kDrift = 1e-4;  ///< [s/s] of two clocks against each other, at most
  static constexpr double kResolution_s = 0.02;  ///< simulated clocks go in such steps
  static constexpr double kMemory_s = 30.0;      ///< as promises: what was settled is to stay so
  static constexpr double kLongest_s = 10.0;     ///< there and back; what takes longer cannot be

  /// Our heartbeat of `sent_s` reached the peer, which `held_s` later, at `stamp_s` of its own
  /// clock, sent the one that reached us at `now` (both ours). What cannot be is passed over.
  void add(double sent_s, double held_s, double stamp_s, double now);

  /// At a time that may lie ahead: until then the clocks drift.
  std::optional<ClockReading> reading(double now) const;

 private:
  friend class ProtocolFingerprint;  // of test/fleet/model

  double delay_s_ = 0.0;  // the mean of about the last ten
  RecentBound ahead_;     // on the offset
  RecentBound behind_;    // on the offset's negative
};

}  // namespace mocha
