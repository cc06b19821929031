#include "fleet/protocol/mistiming.h"

#include <algorithm>
#include <utility>

#include "fleet/protocol/clock_estimate.h"
#include "trajectory/separation.h"

namespace mocha {

Reservation Mistiming::around(Reservation reservation) const {
  reservation.from_s -= error_s;
  reservation.until_s += error_s;
  return reservation;
}

Reservation Mistiming::within(Reservation reservation, double earlier_s) const {
  reservation = around(std::move(reservation));
  reservation.from_s = std::max(reservation.from_s, from_s - earlier_s);
  reservation.until_s = std::min(reservation.until_s, until_s);
  return reservation;
}

Mistiming mistiming(const Motion& a, const Motion& b, double error_s, double now) {
  const double from_s = std::max(a.start_time(), b.start_time());
  const double until_s = std::min(a.end_time(), b.end_time());
  const double later_s = std::max(0.0, until_s - now);
  const double worst_s = std::max(0.0, error_s + ClockEstimate::kDrift * later_s);
  const double speed = worst_s > 0.0 ? std::min(bounds(a).speed, bounds(b).speed) : 0.0;
  return {worst_s, worst_s * speed, from_s - worst_s, until_s + worst_s};
}

}  // namespace mocha
