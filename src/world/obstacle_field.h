#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace mocha {

/// Static obstacles as an optimiser and a prover see them. Implementations are immutable once
/// built.
template <int D>
class ObstacleField {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Box = Eigen::AlignedBox<double, D>;

  struct Sample {
    double
        distance_m;  ///< to the nearest obstacle, negative inside; differentiable almost everywhere
    Vector gradient;  ///< of distance_m
  };

  virtual ~ObstacleField() = default;

  /// For gradients only: interpolated where the implementation samples.
  virtual Sample sample(const Vector& p) const = 0;

  /// A proven lower bound on the distance from p to the nearest obstacle [m], at least 0. For
  /// certificates.
  virtual double distance_bound(const Vector& p) const = 0;

  /// True only if no obstacle is closer than `radius_m` to any point of the box.
  virtual bool clear(const Box& box, double radius_m) const = 0;
};

}  // namespace mocha
