#pragma once

#include <vector>

#include "camouflage/bounded_maps.h"
#include "camouflage/knot_map.h"

namespace mocha {

/// Motion camouflage: each knot moves along the line from its reference point through its place on
/// the prey path, q_k = p_ref + lambda_k (p_prey(k) - p_ref), paper (9), with lambda_k inside
/// bounds that let the knot travel a given distance to either side, paper (13). One variable a
/// knot.
template <int D>
class CamouflageMap : public KnotMap<D> {
 public:
  using typename KnotMap<D>::Knots;

  /// `prey` and `references` are D x K [m], one reference point a knot; `travel_m` > 0 bounds how
  /// far a knot leaves the prey path. Throws std::invalid_argument if sizes differ, values are not
  /// finite or a reference lies on its knot.
  CamouflageMap(const Knots& prey, const Knots& references, double travel_m);

  Parameterisation parameterisation() const override { return Parameterisation::kCamouflage; }
  int knots() const override { return static_cast<int>(prey_.cols()); }
  int variables() const override { return knots(); }
  int variables_of(int) const override { return 1; }
  Eigen::VectorXd initial() const override;
  void place(const double* xi, Knots& knots, Eigen::VectorXd& slopes) const override;
  void pull_back(const Eigen::VectorXd& slopes, const Knots& by_knot, double* by_xi) const override;

  double lambda(int knot, double xi) const { return maps_[knot].value(xi); }

 private:
  Knots prey_;
  Knots references_;
  Knots rays_;  // from the references to the prey
  std::vector<LogisticMap> maps_;
};

extern template class CamouflageMap<2>;
extern template class CamouflageMap<3>;

}  // namespace mocha
