#include "fleet/protocol/clock_estimate.h"

#include <algorithm>

namespace mocha {
namespace {

constexpr double kNewest = 0.1;  // what the newest delay counts in their mean

}  // namespace

double RecentBound::sunk(const Sample& sample, double now) {
  return sample.at_least - ClockEstimate::kDrift * std::max(0.0, now - sample.time_s);
}

bool RecentBound::better(const Sample& a, const std::optional<Sample>& b, double now) {
  return !b || sunk(a, now) >= sunk(*b, now);
}

void RecentBound::add(double at_least, double now) {
  if (!recent_ || now > from_s_ + ClockEstimate::kMemory_s) {
    best_ = recent_;
    recent_ = std::nullopt;
    from_s_ = now;
  }
  const Sample sample{at_least, now};
  if (better(sample, recent_, now)) recent_ = sample;
  if (better(*recent_, best_, now)) best_ = recent_;
}

std::optional<double> RecentBound::at(double now) const {
  if (!best_) return std::nullopt;
  return sunk(*best_, now);
}

void ClockEstimate::add(double sent_s, double held_s, double stamp_s, double now) {
  const double round_trip_s = now - sent_s - held_s;
  if (!(held_s >= 0.0 && round_trip_s >= -kResolution_s && round_trip_s <= kLongest_s)) return;
  const double delay_s = std::max(0.0, 0.5 * round_trip_s);
  delay_s_ = reading(now) ? delay_s_ + kNewest * (delay_s - delay_s_) : delay_s;
  const double at_least_s = stamp_s - now;
  const double at_most_s = stamp_s - held_s - sent_s;
  if (const auto known = reading(now)) {
    const double least_s = known->offset_s - known->uncertainty_s;
    const double most_s = known->offset_s + known->uncertainty_s;
    if (at_least_s - kResolution_s > most_s || at_most_s + kResolution_s < least_s)
      ahead_ = behind_ = RecentBound();
  }
  ahead_.add(at_least_s, now);
  behind_.add(-at_most_s, now);
}

std::optional<ClockReading> ClockEstimate::reading(double now) const {
  const auto at_least_s = ahead_.at(now);
  const auto less_at_most_s = behind_.at(now);
  if (!at_least_s || !less_at_most_s) return std::nullopt;
  return ClockReading{0.5 * (*at_least_s - *less_at_most_s),
                      -0.5 * (*at_least_s + *less_at_most_s) + kResolution_s, delay_s_};
}

}  // namespace mocha
