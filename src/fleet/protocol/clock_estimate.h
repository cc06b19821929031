#pragma once

#include <optional>

namespace mocha {

/// What an exchange says of a peer's clock: the offset (the peer's clock less ours) lies within
/// `uncertainty_s` of `offset_s`, however the delay divides between there and back.
struct ClockReading {
  double offset_s = 0.0;
  double uncertainty_s = 0.0;
  double delay_s = 0.0;  ///< of a message these days, there and back halved
};

/// Where a peer's clock stands against ours, from heartbeats that are echoed: a message that goes
/// one way cannot tell an offset from a delay, one that comes back can.
///
/// The exchange with the shortest way there and back, of those of the last ten to twenty seconds,
/// says most. Readings widen with their age, as clocks drift. One that contradicts the best means
/// that a clock was set; then it alone counts.
class ClockEstimate {
 public:
  static constexpr double kDrift = 1e-4;  ///< [s/s] of two clocks against each other, at most
  static constexpr double kResolution_s = 0.02;  ///< simulated clocks go in such steps
  static constexpr double kMemory_s = 10.0;

  /// Our heartbeat of `sent_s` reached the peer, which `held_s` later, at `stamp_s` of its own
  /// clock, sent the one that reached us at `now` (both ours). What cannot be is passed over.
  void add(double sent_s, double held_s, double stamp_s, double now);

  std::optional<ClockReading> reading(double now) const;

 private:
  friend class ProtocolFingerprint;  // of test/fleet/model

  struct Sample {
    ClockReading reading;
    double time_s;
  };
  static ClockReading widened(const Sample& sample, double now);
  static bool better(const Sample& a, const std::optional<Sample>& b, double now);

  double delay_s_ = 0.0;          // the mean of about the last ten
  std::optional<Sample> best_;    // since from_s_ less kMemory_s
  std::optional<Sample> recent_;  // since from_s_
  double from_s_ = 0.0;
};

}  // namespace mocha
