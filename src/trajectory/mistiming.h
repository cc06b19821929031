#pragma once

#include "trajectory/motion.h"

namespace mocha {

/// How much closer two robots may come than two motions of theirs say, where either motion may be
/// early or late: by what the slower robot drives in that time (take its motion for the one that is
/// early or late), and only while both move (one that stands is there at any time).
struct Mistiming {
  double loss_m = 0.0;
  double from_s = 0.0;
  double until_s = 0.0;

  double loss_at(double t) const { return t >= from_s && t <= until_s ? loss_m : 0.0; }
};

/// Where they may be early or late by so much.
Mistiming mistiming(const Motion& a, const Motion& b, double error_s);

}  // namespace mocha
