#include "perception/tracking/constant_velocity_filter.h"

#include <Eigen/LU>
#include <cmath>

namespace mocha {
namespace {

using Matrix2 = Eigen::Matrix2d;
using Matrix4 = Eigen::Matrix4d;

}  // namespace

ConstantVelocityFilter::ConstantVelocityFilter(double time_s, const Vector2& position,
                                               const Matrix2& noise, double speed_sigma_mps)
    : time_s_(time_s), covariance_(Matrix4::Zero()) {
  state_ << position, 0.0, 0.0;
  covariance_.topLeftCorner<2, 2>() = noise;
  covariance_.diagonal().tail<2>().setConstant(speed_sigma_mps * speed_sigma_mps);
}

void ConstantVelocityFilter::predict(double time_s, double acceleration_psd) {
  const double step = time_s - time_s_;
  const double length = std::abs(step);
  Matrix4 transition = Matrix4::Identity();
  transition.topRightCorner<2, 2>() = step * Matrix2::Identity();
  state_ = transition * state_;
  covariance_ = transition * covariance_ * transition.transpose();
  const Matrix2 density = acceleration_psd * Matrix2::Identity();
  covariance_.topLeftCorner<2, 2>() += length * length * length / 3.0 * density;
  covariance_.topRightCorner<2, 2>() += 0.5 * length * step * density;
  covariance_.bottomLeftCorner<2, 2>() += 0.5 * length * step * density;
  covariance_.bottomRightCorner<2, 2>() += length * density;
  time_s_ = time_s;
}

ConstantVelocityFilter::Mismatch ConstantVelocityFilter::mismatch(const Vector2& position,
                                                                  const Matrix2& noise) const {
  const Matrix2 S = covariance_.topLeftCorner<2, 2>() + noise;
  const Vector2 off = position - state_.head<2>();
  return {off.dot(S.inverse() * off), std::log(S.determinant())};
}

void ConstantVelocityFilter::update(const Vector2& position, const Matrix2& noise) {
  const Eigen::Matrix<double, 4, 2> gain =
      covariance_.leftCols<2>() * (covariance_.topLeftCorner<2, 2>() + noise).inverse();
  state_ += gain * (position - state_.head<2>());
  Matrix4 kept = Matrix4::Identity();  // Joseph's form: stays symmetric and positive
  kept.leftCols<2>() -= gain;
  covariance_ = (kept * covariance_ * kept.transpose()).eval() + gain * noise * gain.transpose();
}

}  // namespace mocha
