#pragma once

#include <vector>

#include "trajectory/motion.h"

namespace mocha {

// Errors of an estimated trajectory against a reference, both with a pose for each time (Sturm et
// al., IROS 2012).

/// Distances between positions, after the estimate is turned and moved to fit best (least squares).
std::vector<double> absolute_errors_m(const std::vector<Pose>& estimate,
                                      const std::vector<Pose>& reference);

struct RelativeErrors {
  std::vector<double> off_m;
  std::vector<double> off_rad;
};

/// Of the motion between every pose and the first one that lies `length_m` of driving after it.
RelativeErrors relative_errors(const std::vector<Pose>& estimate,
                               const std::vector<Pose>& reference, double length_m);

// Of none: 0.
double quantile(std::vector<double> values, double share);
double mean(const std::vector<double>& values);
double rms(const std::vector<double>& values);

}  // namespace mocha
