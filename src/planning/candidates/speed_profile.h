#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "world/robot_model.h"

namespace mocha {

/// Knots on a front-end path and durations between them, from which an optimisation starts.
template <int D>
struct InitialKnots {
  Eigen::Matrix<double, D, Eigen::Dynamic> path;  ///< start, interior knots, end [m]
  Eigen::VectorXd durations_s;                    ///< one fewer than points

  /// How far the path is driven on, about, while an eta, paper (12), grows by one: mean speed times
  /// slope.
  double metres_per_eta() const;
};

/// The highest speed [m/s] that a place allows, above 0.
template <int D>
using SpeedAt = std::function<double(const Eigen::Matrix<double, D, 1>&)>;

/// A trapezoidal speed profile along a path whose corners are rounded, slower there, to rest at the
/// end.
template <int D>
class SpeedProfile {
 public:
  using Points = std::vector<Eigen::Matrix<double, D, 1>>;

  /// Throws std::invalid_argument for fewer than two points, for points that are not finite, and
  /// for limits that are not above 0. The path begins at `start_speed` >= 0 [m/s]; corners are
  /// rounded over about `window_m`, so that knots do not carry the kinks and the jitter of a
  /// searched path into directions in which they cannot move. `fastest_at` may be empty.
  SpeedProfile(const Points& points, double start_speed, const MotionLimits& limits,
               double window_m, const SpeedAt<D>& fastest_at);

  double duration_s() const { return times_s_.back(); }

  /// Knots between `pieces` >= 1 pieces of uniform TIME, so that slow stretches get more of them.
  InitialKnots<D> knots(int pieces) const;

 private:
  Points samples_;
  std::vector<double> times_s_;  // at which the samples are reached
};

extern template struct InitialKnots<2>;
extern template struct InitialKnots<3>;
extern template class SpeedProfile<2>;
extern template class SpeedProfile<3>;

/// Knots of that profile, about `spacing_m` > 0 apart at full speed; farther, where they would be
/// thousands.
template <int D>
InitialKnots<D> spread_knots(const std::vector<Eigen::Matrix<double, D, 1>>& points,
                             double start_speed, const MotionLimits& limits, double spacing_m,
                             const SpeedAt<D>& fastest_at = {});

extern template InitialKnots<2> spread_knots<2>(const std::vector<Eigen::Vector2d>&, double,
                                                const MotionLimits&, double, const SpeedAt<2>&);
extern template InitialKnots<3> spread_knots<3>(const std::vector<Eigen::Vector3d>&, double,
                                                const MotionLimits&, double, const SpeedAt<3>&);

}  // namespace mocha
