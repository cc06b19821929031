#pragma once

#include <Eigen/Core>

#include "trajectory/motion.h"

namespace mocha {

/// Kalman filter of a point at nearly constant velocity: state (x, y, vx, vy), white acceleration.
class ConstantVelocityFilter {
 public:
  /// Begins at a measured position, with the covariance of its error [m^2], and a velocity of zero
  /// with an error of `speed_sigma_mps` along each axis.
  ConstantVelocityFilter(double time_s, const Vector2& position, const Eigen::Matrix2d& noise,
                         double speed_sigma_mps);

  /// Moves to another time, also backward: whichever way, the uncertainty grows.
  /// `acceleration_psd` is the power spectral density of the acceleration [m^2/s^3].
  void predict(double time_s, double acceleration_psd);

  /// How far a measured position is from the predicted one.
  struct Mismatch {
    double squared;  ///< Mahalanobis distance, squared: chi-squared with two degrees of freedom
    double log_determinant;  ///< of the innovation's covariance
  };
  Mismatch mismatch(const Vector2& position, const Eigen::Matrix2d& noise) const;

  /// A position measured at the time of the state; `noise` is the covariance of its error [m^2].
  void update(const Vector2& position, const Eigen::Matrix2d& noise);

  double time_s() const { return time_s_; }
  Vector2 position() const { return state_.head<2>(); }
  Vector2 velocity() const { return state_.tail<2>(); }
  const Eigen::Matrix4d& covariance() const { return covariance_; }

 private:
  double time_s_;
  Eigen::Vector4d state_;
  Eigen::Matrix4d covariance_;
};

}  // namespace mocha
