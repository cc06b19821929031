#pragma once

#include "fleet/protocol/reservation_chain.h"

namespace mocha {

/// How much closer two robots may come than two motions of theirs say, where the one motion may be
/// early or late: by what the slower robot drives in that time (take its motion for the one that is
/// early or late), and only while both move (one that stands is there at any time).
struct Mistiming {
  double error_s = 0.0;  ///< early or late by so much at most
  double loss_m = 0.0;
  double from_s = 0.0;
  double until_s = 0.0;

  /// The reservation, which may begin and end early or late.
  Reservation around(Reservation reservation) const;
  /// Of that, the times at which distance may be lost, and `earlier_s` before.
  Reservation within(Reservation reservation, double earlier_s = 0.0) const;
};

/// From `now` on, where the error is so much now, and grows as clocks drift; negative: margins
/// allow for as much more.
Mistiming mistiming(const Motion& a, const Motion& b, double error_s, double now);

}  // namespace mocha
