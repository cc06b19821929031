#pragma once

#include <Eigen/Core>
#include <vector>

#include "planning/candidates/speed_profile.h"

namespace mocha {

/// A path that is at its points at given times, straight between them, and beyond its ends goes on
/// with the velocities there.
template <int D>
struct TimedGuide {
  using Vector = Eigen::Matrix<double, D, 1>;

  std::vector<Vector> points;   ///< [m]
  std::vector<double> times_s;  ///< increasing, from 0
  Vector start_velocity = Vector::Zero();
  Vector end_velocity = Vector::Zero();

  Vector at(double t) const;
};

/// Knots of such a path at even times, speed and direction averaged over `window_s`: so they change
/// gradually, also from and to what they are at the ends.
template <int D>
InitialKnots<D> even_knots(const TimedGuide<D>& guide, int pieces, double window_s);

extern template InitialKnots<2> even_knots(const TimedGuide<2>&, int, double);
extern template InitialKnots<3> even_knots(const TimedGuide<3>&, int, double);

}  // namespace mocha
