#include "optimization/trajectory_objective.h"

#include <algorithm>
#include <numeric>

#include "camouflage/bounded_maps.h"

namespace mocha {

template <int D, int S>
TrajectoryObjective<D, S>::TrajectoryObjective(Options options)
    : options_(std::move(options)),
      quadrature_(options_.kappa, pieces(), options_.penalties.size()),
      knots_(D, pieces() - 1),
      by_knot_(D, pieces() - 1),
      slopes_(options_.knot_map->variables()),
      durations_(pieces()),
      by_duration_(pieces()),
      by_piece_(pieces()),
      shares_(options_.penalties.size()) {
  minco_.resize(pieces());
}

template <int D, int S>
Eigen::VectorXd TrajectoryObjective<D, S>::initial(const Eigen::VectorXd& durations_s) const {
  Eigen::VectorXd x(variables());
  x.head(options_.knot_map->variables()) = options_.knot_map->initial();
  for (int i = 0; i < pieces(); ++i) {
    x[options_.knot_map->variables() + i] = options_.metres_per_eta * eta_of(durations_s[i]);
  }
  return x;
}

template <int D, int S>
double TrajectoryObjective<D, S>::evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
  const KnotMap<D>& map = *options_.knot_map;
  const double eta_per_metre = 1.0 / options_.metres_per_eta;
  const auto eta = eta_per_metre * x.tail(pieces());
  map.place(x.data(), knots_, slopes_);
  for (int i = 0; i < pieces(); ++i) durations_[i] = duration_of(eta[i]);
  minco_.solve(options_.start, options_.end, knots_, durations_);

  for (Piece& piece : by_piece_) piece.setZero();
  std::fill(shares_.begin(), shares_.end(), 0.0);
  const double total_s = durations_.sum();
  effort_ = options_.effort_weight * minco_.effort();
  duration_ = options_.duration_cost.value(total_s);
  by_duration_.setConstant(options_.duration_cost.slope(total_s));
  minco_.add_effort_gradient(options_.effort_weight, by_piece_, by_duration_);
  const double penalty =
      quadrature_.add(minco_, options_.penalties, by_piece_, by_duration_, shares_);
  minco_.propagate(by_piece_, by_duration_, by_knot_);

  map.pull_back(slopes_, by_knot_, gradient.data());
  for (int i = 0; i < pieces(); ++i) {
    gradient[map.variables() + i] =
        eta_per_metre * by_duration_[i] * duration_slope(eta[i], durations_[i]);
  }
  return effort_ + duration_ + penalty;
}

template <int D, int S>
CostTerms TrajectoryObjective<D, S>::terms() const {
  CostTerms terms = {{"control_effort", effort_}, {"duration", duration_}};
  for (std::size_t p = 0; p < shares_.size(); ++p) {
    terms.emplace_back(options_.penalties[p]->name(), shares_[p]);
  }
  return terms;
}

template class TrajectoryObjective<2, 2>;
template class TrajectoryObjective<2, 3>;
template class TrajectoryObjective<2, 4>;
template class TrajectoryObjective<3, 2>;
template class TrajectoryObjective<3, 3>;
template class TrajectoryObjective<3, 4>;

}  // namespace mocha
