#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "camouflage/knot_map.h"
#include "optimization/curvature_model.h"
#include "optimization/duration_cost.h"
#include "optimization/time_quadrature.h"
#include "trajectory/minco.h"

namespace mocha {

/// A cost by its parts, weighted as they enter the sum.
using CostTerms = std::vector<std::pair<std::string, double>>;

/// J_total, paper (14), over unconstrained variables: those of the knot map first, then one scaled
/// eta a piece, paper (12). After construction and set_knot_map() evaluating it allocates nothing.
template <int D, int S>
class TrajectoryObjective {
 public:
  using State = typename Minco<D, S>::State;
  using Knots = typename Minco<D, S>::Knots;

  struct Options {
    State start;  ///< columns: position, velocity, acceleration ...
    State end;
    std::shared_ptr<const KnotMap<D>> knot_map;
    double effort_weight;  ///< w_e
    DurationCost duration_cost;
    std::vector<std::unique_ptr<Penalty<D>>> penalties;
    int kappa;
    /// How far the trajectory moves along itself, about, when one eta grows by one [m]. A variable
    /// is eta times this, so that one unit of it moves as much as one unit of a knot's does: the
    /// solver converges faster where all variables are alike.
    double metres_per_eta;
  };

  explicit TrajectoryObjective(Options options);

  /// Places other knots, as many as there are, from now on.
  void set_knot_map(std::shared_ptr<const KnotMap<D>> knot_map);

  int variables() const { return options_.knot_map->variables() + pieces(); }
  Parameterisation parameterisation() const { return options_.knot_map->parameterisation(); }
  int pieces() const { return options_.knot_map->knots() + 1; }

  /// The knots on the prey path, and the given durations [s].
  Eigen::VectorXd initial(const Eigen::VectorXd& durations_s) const;

  /// The cost at x, and its gradient.
  double evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& gradient);

  /// Makes a model of the curvature at the last evaluation, see CurvatureModel. `damping` >= 0 is
  /// added to it in all directions. False where that is not enough to make it positive definite.
  bool prepare_steps(double damping);

  /// A gradient becomes the step to where it vanishes by the newest model, backwards.
  void to_step(Eigen::VectorXd& gradient) { curvature_.solve(gradient); }

  /// The trajectory and the cost's parts of the last evaluation.
  typename Minco<D, S>::Curve curve() const { return minco_.curve(); }
  double effort() const { return effort_; }
  double effort_weight() const { return options_.effort_weight; }
  double duration_cost() const { return duration_; }
  /// The cost's derivative by the logarithm of a factor on all durations.
  double by_pace() const { return by_duration_.dot(durations_); }
  CostTerms terms() const;
  /// Of all penalties over one piece.
  double penalty(int piece) const { return quadrature_.integral(piece); }

 private:
  using Piece = typename Minco<D, S>::Piece;

  Options options_;
  Minco<D, S> minco_;
  TimeQuadrature<D, S> quadrature_;
  CurvatureModel<D, S> curvature_;
  Knots tangents_;  // of the knots by their variables
  Knots knots_;
  Knots by_knot_;
  Eigen::VectorXd slopes_;  // of the knot map
  Eigen::VectorXd durations_;
  Eigen::VectorXd by_duration_;
  Eigen::VectorXd row_;  // of the tangents
  Eigen::VectorXd eta_;
  std::vector<Piece> by_piece_;
  std::vector<double> shares_;
  double effort_ = 0.0;
  double duration_ = 0.0;
};

extern template class TrajectoryObjective<2, 3>;
extern template class TrajectoryObjective<3, 3>;

}  // namespace mocha
