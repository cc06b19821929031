#pragma once

namespace mocha {

/// Total flight time as a cost: w_t T (34).
struct DurationCost {
  double weight;  ///< [1/s]

  double value(double total_s) const { return weight * total_s; }
  double slope(double) const { return weight; }
};

}  // namespace mocha
