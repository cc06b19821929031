#include "camouflage/camouflage_map.h"

#include <stdexcept>

namespace mocha {

template <int D>
CamouflageMap<D>::CamouflageMap(const Knots& prey, const Knots& references, double travel_m)
    : prey_(prey), references_(references) {
  if (prey.cols() != references.cols()) {
    throw std::invalid_argument("CamouflageMap: needs one reference point a knot");
  }
  if (!(travel_m > 0.0) || !prey.allFinite() || !references.allFinite()) {
    throw std::invalid_argument("CamouflageMap: travel is not positive or a point is not finite");
  }
  rays_ = prey - references;
  for (int k = 0; k < knots(); ++k) {
    const double leverage_m = rays_.col(k).norm();
    if (!(leverage_m > 1e-6)) {
      throw std::invalid_argument("CamouflageMap: a reference point lies on the prey path");
    }
    const double reach = travel_m / leverage_m;
    // The logistic's slope at the prey path is (high - low) scale / 4 = 1 / leverage: one unit is a
    // metre there.
    maps_.push_back({1.0 - reach, 1.0 + reach, 2.0 / travel_m});
  }
}

template <int D>
Eigen::VectorXd CamouflageMap<D>::initial() const {
  return Eigen::VectorXd::Zero(knots());
}

template <int D>
void CamouflageMap<D>::place(const double* xi, Knots& knots, Eigen::VectorXd& slopes) const {
  for (int k = 0; k < this->knots(); ++k) {
    const auto [lambda, slope] = maps_[k].value_and_slope(xi[k]);
    knots.col(k) = references_.col(k) + lambda * rays_.col(k);
    slopes[k] = slope;
  }
}

template <int D>
void CamouflageMap<D>::pull_back(const Eigen::VectorXd& slopes, const Knots& by_knot,
                                 double* by_xi) const {
  for (int k = 0; k < knots(); ++k) {
    by_xi[k] = by_knot.col(k).dot(rays_.col(k)) * slopes[k];
  }
}

template class CamouflageMap<2>;
template class CamouflageMap<3>;

}  // namespace mocha
