#include "camouflage/adaptive_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace mocha {
namespace {

constexpr double kSaturated = 1.0 - 1e-6;  // of the travel, where the logistic has no inverse

/// Unit axes across a unit vector, after it.
template <int D>
Eigen::Matrix<double, D, D> axes_after(const Eigen::Matrix<double, D, 1>& first) {
  Eigen::Matrix<double, D, D> axes;
  axes.col(0) = first;
  axes.col(1) = first.unitOrthogonal();
  if constexpr (D == 3) axes.col(2) = first.cross(axes.col(1));
  return axes;
}

}  // namespace

template <int D>
RayKnot<D> RayKnot<D>::on_ray(const Vector& prey, const Vector& ray) {
  RayKnot knot;
  knot.prey = prey;
  knot.axes = axes_after<D>(ray.normalized());
  return knot;
}

template <int D>
auto RayKnot<D>::across(const Vector& gradient) const -> Vector {
  Vector rest = gradient;
  for (int axis = 0; axis < freedom; ++axis) rest -= gradient.dot(axes.col(axis)) * axes.col(axis);
  return rest;
}

template <int D>
void RayKnot<D>::promote(const Vector& gradient) {
  if (freedom == D) return;
  if constexpr (D == 3) {
    const Vector steepest = across(gradient);
    if (freedom == 1 && steepest.norm() > 0.0) {
      const Vector place = axes * offset;
      axes.col(1) = steepest.normalized();
      axes.col(2) = axes.col(0).cross(axes.col(1));
      offset = axes.transpose() * place;
    }
  }
  ++freedom;
}

template <int D>
AdaptiveMap<D>::AdaptiveMap(std::vector<RayKnot<D>> knots, double travel_m)
    : knots_(std::move(knots)), travel_m_(travel_m) {
  if (!(travel_m > 0.0)) {
    throw std::invalid_argument("AdaptiveMap: travel_m is " + std::to_string(travel_m) +
                                ", allowed is above 0");
  }
  for (const RayKnot<D>& knot : knots_) {
    if (knot.freedom < 1 || knot.freedom > D) {
      throw std::invalid_argument("AdaptiveMap: freedom is " + std::to_string(knot.freedom) +
                                  ", allowed is 1 to " + std::to_string(D));
    }
    if (!(knot.units_per_m > 0.0) || !knot.position().allFinite()) {
      throw std::invalid_argument("AdaptiveMap: units_per_m is not above 0 or a knot not finite");
    }
    variables_ += knot.freedom;
  }
}

template <int D>
Parameterisation AdaptiveMap<D>::parameterisation() const {
  return variables_ == knots() ? Parameterisation::kCamouflage : Parameterisation::kWaypoints;
}

/// Where the knot is on its prey, a unit of the variable is 1 / units_per_m.
template <int D>
LogisticMap AdaptiveMap<D>::along_ray(const RayKnot<D>& knot) const {
  return {-travel_m_, travel_m_, 2.0 / (travel_m_ * knot.units_per_m)};
}

template <int D>
Eigen::VectorXd AdaptiveMap<D>::initial() const {
  Eigen::VectorXd x(variables_);
  int v = 0;
  for (const RayKnot<D>& knot : knots_) {
    const double most_m = kSaturated * travel_m_;
    x[v++] = along_ray(knot).inverse(std::clamp(knot.offset[0], -most_m, most_m));
    for (int axis = 1; axis < knot.freedom; ++axis) x[v++] = knot.units_per_m * knot.offset[axis];
  }
  return x;
}

template <int D>
void AdaptiveMap<D>::place(const double* x, Knots& knots, Eigen::VectorXd& slopes) const {
  int v = 0;
  for (int k = 0; k < this->knots(); ++k) {
    const RayKnot<D>& knot = knots_[k];
    Eigen::Matrix<double, D, 1> offset = knot.offset;
    std::tie(offset[0], slopes[v]) = along_ray(knot).value_and_slope(x[v]);
    for (int axis = 1; axis < knot.freedom; ++axis) {
      slopes[v + axis] = 1.0 / knot.units_per_m;
      offset[axis] = x[v + axis] / knot.units_per_m;
    }
    knots.col(k) = knot.prey + knot.axes * offset;
    v += knot.freedom;
  }
}

template <int D>
void AdaptiveMap<D>::pull_back(const Eigen::VectorXd& slopes, const Knots& by_knot,
                               double* by_x) const {
  int v = 0;
  for (int k = 0; k < knots(); ++k) {
    for (int axis = 0; axis < knots_[k].freedom; ++axis, ++v)
      by_x[v] = slopes[v] * by_knot.col(k).dot(knots_[k].axes.col(axis));
  }
}

template <int D>
std::vector<RayKnot<D>> AdaptiveMap<D>::moved(const double* x) const {
  std::vector<RayKnot<D>> moved = knots_;
  int v = 0;
  for (RayKnot<D>& knot : moved) {
    knot.offset[0] = along_ray(knot).value(x[v]);
    for (int axis = 1; axis < knot.freedom; ++axis)
      knot.offset[axis] = x[v + axis] / knot.units_per_m;
    v += knot.freedom;
  }
  return moved;
}

template struct RayKnot<2>;
template struct RayKnot<3>;
template class AdaptiveMap<2>;
template class AdaptiveMap<3>;

}  // namespace mocha
