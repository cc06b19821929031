#include "optimization/trajectory_objective.h"

#include <algorithm>
#include <numeric>

#include "camouflage/bounded_maps.h"

namespace mocha {
namespace {

// The model of the curvature lets the derivatives at the knots be free, while they follow the
// knots, for the least effort. With its true weight they would evade each penalty at no cost, and
// steps would be far too long; with this much more they do follow. By measurement: 300 to 3000 need
// about as many evaluations, 1 and 10,000 several times as many.
constexpr double kSmoothness = 1000.0;

}  // namespace

template <int D, int S>
TrajectoryObjective<D, S>::TrajectoryObjective(Options options)
    : options_(std::move(options)),
      quadrature_(options_.kappa, pieces(), options_.penalties.size()),
      curvature_({}),
      shares_(options_.penalties.size()) {
  set_knot_map(options_.knot_map);
}

template <int D, int S>
void TrajectoryObjective<D, S>::set_knot_map(std::shared_ptr<const KnotMap<D>> knot_map) {
  options_.knot_map = std::move(knot_map);
  const KnotMap<D>& map = *options_.knot_map;
  std::vector<int> per_knot;
  for (int k = 0; k < map.knots(); ++k) per_knot.push_back(map.variables_of(k));
  curvature_ = CurvatureModel<D, S>(std::move(per_knot));
  minco_.resize(pieces());
  quadrature_.resize(pieces());
  tangents_.resize(D, map.variables());
  knots_.resize(D, map.knots());
  by_knot_.resize(D, map.knots());
  slopes_.resize(map.variables());
  row_.resize(map.variables());
  durations_.resize(pieces());
  by_duration_.resize(pieces());
  eta_.resize(pieces());
  by_piece_.resize(pieces());
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
  eta_ = eta_per_metre * x.tail(pieces());
  map.place(x.data(), knots_, slopes_);
  for (int i = 0; i < pieces(); ++i) durations_[i] = duration_of(eta_[i]);
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
        eta_per_metre * by_duration_[i] * duration_slope(eta_[i], durations_[i]);
  }
  return effort_ + duration_ + penalty;
}

template <int D, int S>
bool TrajectoryObjective<D, S>::prepare_steps(double damping) {
  const KnotMap<D>& map = *options_.knot_map;
  for (int axis = 0; axis < D; ++axis) {
    by_knot_.setZero();
    by_knot_.row(axis).setOnes();
    map.pull_back(slopes_, by_knot_, row_.data());
    tangents_.row(axis) = row_;
  }
  curvature_.clear();
  double start_s = 0.0;
  for (int i = 0; i < pieces(); ++i) {
    const auto& piece = quadrature_.curvature(minco_, options_.penalties,
                                              kSmoothness * options_.effort_weight, i, start_s);
    start_s += durations_[i];
    const double slope = duration_slope(eta_[i], durations_[i]) / options_.metres_per_eta;
    curvature_.add(i, piece, tangents_, slope);
  }
  return curvature_.factor(damping);
}

template <int D, int S>
CostTerms TrajectoryObjective<D, S>::terms() const {
  CostTerms terms = {{"control_effort", effort_}, {"duration", duration_}};
  for (std::size_t p = 0; p < shares_.size(); ++p) {
    terms.emplace_back(options_.penalties[p]->name(), shares_[p]);
  }
  return terms;
}

template class TrajectoryObjective<2, 3>;
template class TrajectoryObjective<3, 3>;

}  // namespace mocha
