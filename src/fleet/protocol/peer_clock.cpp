#include "fleet/protocol/peer_clock.h"

#include <algorithm>
#include <cmath>

namespace mocha {
namespace {

constexpr double kWorthTelling_s = 5e-3;  // smaller corrections are not worth telling all anew

}  // namespace

double PeerClock::add(double sent_s, double held_s, double stamp_s, double tolerance_s,
                      double now) {
  estimate_.add(sent_s, held_s, stamp_s, now);
  const auto reading = estimate_.reading(now);
  if (!reading || mistimed_s(tolerance_s, now) == 0.0) return 0.0;
  const double later_s = ahead_s_ - reading->offset_s;
  if (std::abs(later_s) < kWorthTelling_s) return 0.0;
  ahead_s_ = reading->offset_s;
  return later_s;
}

std::optional<double> PeerClock::error_s(double now) const {
  const auto reading = estimate_.reading(now);
  if (!reading) return std::nullopt;
  return reading->uncertainty_s + std::abs(reading->offset_s - ahead_s_);
}

double PeerClock::mistimed_s(double tolerance_s, double now) const {
  return std::max(0.0, error_s(now).value_or(0.0) - tolerance_s);
}

}  // namespace mocha
