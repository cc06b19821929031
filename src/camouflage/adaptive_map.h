#pragma once

#include <vector>

#include "camouflage/bounded_maps.h"
#include "camouflage/knot_map.h"

namespace mocha {

/// A knot that moves along its ray, by one variable as in camouflage, paper (9), and along further
/// axes only where that is worth a variable more.
template <int D>
struct RayKnot {
  using Vector = Eigen::Matrix<double, D, 1>;
  using Axes = Eigen::Matrix<double, D, D>;

  Vector prey;                     ///< where it begins: on the prey path, or on a curve [m]
  Axes axes;                       ///< orthonormal columns, the ray's direction first
  Vector offset = Vector::Zero();  ///< from the prey along each axis [m]
  int freedom = 1;                 ///< along how many of the axes it moves, from 1 to D
  double units_per_m = 1.0;        ///< of its variables

  /// On a ray that is not zero.
  static RayKnot on_ray(const Vector& prey, const Vector& ray);

  Vector position() const { return prey + axes * offset; }

  /// The part of a gradient along the axes on which it does not move.
  Vector across(const Vector& gradient) const;

  /// Lets it move along one axis more, the one along which the gradient is steepest, if there is
  /// one.
  void promote(const Vector& gradient);
};

/// Knots with as many variables each as they need. Along its ray a knot stays within `travel_m` of
/// its prey, as in CamouflageMap.
template <int D>
class AdaptiveMap : public KnotMap<D> {
 public:
  using typename KnotMap<D>::Knots;

  /// Throws std::invalid_argument for a travel or a scale that is not above 0, a freedom out of
  /// range, and values that are not finite.
  AdaptiveMap(std::vector<RayKnot<D>> knots, double travel_m);

  /// Waypoints as soon as one knot has more than its ray.
  Parameterisation parameterisation() const override;
  int knots() const override { return static_cast<int>(knots_.size()); }
  int variables() const override { return variables_; }
  int variables_of(int knot) const override { return knots_[knot].freedom; }
  Eigen::VectorXd initial() const override;
  void place(const double* x, Knots& knots, Eigen::VectorXd& slopes) const override;
  void pull_back(const Eigen::VectorXd& slopes, const Knots& by_knot, double* by_x) const override;

  /// The same knots where the variables put them.
  std::vector<RayKnot<D>> moved(const double* x) const;

 private:
  LogisticMap along_ray(const RayKnot<D>& knot) const;

  std::vector<RayKnot<D>> knots_;
  double travel_m_;
  int variables_ = 0;
};

extern template struct RayKnot<2>;
extern template struct RayKnot<3>;
extern template class AdaptiveMap<2>;
extern template class AdaptiveMap<3>;

}  // namespace mocha
