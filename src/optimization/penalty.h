#pragma once

#include <Eigen/Core>

namespace mocha {

/// phi(x) = max(0, x)^3 (31) and its derivative.
struct Cubic {
  double value;
  double slope;
};

inline Cubic cubic(double x) {
  if (x <= 0.0) return {0.0, 0.0};
  return {x * x * x, 3.0 * x * x};
}

/// One sample of a trajectory: what a penalty sees.
template <int D>
struct TrajectorySample {
  using Vector = Eigen::Matrix<double, D, 1>;
  Vector position;               ///< [m]
  Vector velocity;               ///< [m/s]
  Vector acceleration;           ///< [m/s^2]
  double time_s;                 ///< from the start of the trajectory: tau_f of (22)
  Vector jerk = Vector::Zero();  ///< [m/s^3]
};

/// Gradient of a penalty by the sample's entries; penalties add to it.
template <int D>
struct SampleGradient {
  using Vector = Eigen::Matrix<double, D, 1>;
  Vector by_position = Vector::Zero();
  Vector by_velocity = Vector::Zero();
  Vector by_acceleration = Vector::Zero();
  Vector by_jerk = Vector::Zero();
  double by_time = 0.0;
};

/// One term of J_p (14): its value per second of trajectory at one sample (21).
///
/// Penalties are dimensionless: what is to be avoided is measured against its limit before (31) is
/// applied, so that one set of weights serves robots of every size. The paper's form follows with
/// the weight times the limit to the sixth.
template <int D>
class Penalty {
 public:
  virtual ~Penalty() = default;
  /// A short name for reports, such as "obstacle".
  virtual const char* name() const = 0;
  /// The weighted penalty [1/s]; its gradient is added.
  virtual double add(const TrajectorySample<D>& sample, SampleGradient<D>& gradient) const = 0;
};

}  // namespace mocha
