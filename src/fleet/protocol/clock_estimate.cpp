#include "fleet/protocol/clock_estimate.h"

#include <algorithm>
#include <cmath>

namespace mocha {
namespace {

constexpr double kNewest = 0.1;  // what the newest delay counts in their mean

}  // namespace

ClockReading ClockEstimate::widened(const Sample& sample, double now) {
  ClockReading reading = sample.reading;
  reading.uncertainty_s += kDrift * std::max(0.0, now - sample.time_s);
  return reading;
}

bool ClockEstimate::better(const Sample& a, const std::optional<Sample>& b, double now) {
  return !b || widened(a, now).uncertainty_s <= widened(*b, now).uncertainty_s;
}

void ClockEstimate::add(double sent_s, double held_s, double stamp_s, double now) {
  const double round_trip_s = now - sent_s - held_s;
  if (!(held_s >= 0.0 && round_trip_s >= -kResolution_s && round_trip_s <= kMemory_s)) return;
  const double delay_s = std::max(0.0, 0.5 * round_trip_s);
  const Sample sample{{stamp_s - (now - delay_s), delay_s + kResolution_s, delay_s}, now};
  delay_s_ = best_ ? delay_s_ + kNewest * (delay_s - delay_s_) : delay_s;
  if (best_) {
    const ClockReading known = widened(*best_, now);
    const double apart_s = std::abs(known.offset_s - sample.reading.offset_s);
    if (apart_s > known.uncertainty_s + sample.reading.uncertainty_s)
      best_ = recent_ = std::nullopt;
  }
  if (!recent_ || now > from_s_ + kMemory_s) {
    best_ = recent_;
    recent_ = std::nullopt;
    from_s_ = now;
  }
  if (better(sample, recent_, now)) recent_ = sample;
  if (better(*recent_, best_, now)) best_ = recent_;
}

std::optional<ClockReading> ClockEstimate::reading(double now) const {
  if (!best_) return std::nullopt;
  ClockReading reading = widened(*best_, now);
  reading.delay_s = delay_s_;
  return reading;
}

}  // namespace mocha
