#include "optimization/adaptive_optimizer.h"

#include <algorithm>
#include <memory>

#include "optimization/knot_refinement.h"
#include "optimization/pace.h"

namespace mocha {
namespace {

constexpr double kRough = 1e-3;        // fall of the cost at which the first round stops
constexpr double kNegligible = 2e-3;   // of the cost: estimated gains that are left out in all
constexpr int kRounds = 4;             // at most
constexpr double kMostScaling = 10.0;  // between the variables of knots near and far apart

/// The closer knots are, the more a metre of one costs: variables are scaled so that they are alike
/// to the solver.
template <int D>
void scale_variables(KnotChain<D>& chain) {
  const double mean_s = chain.durations_s.mean();
  for (std::size_t k = 0; k < chain.knots.size(); ++k) {
    const double spacing_s = 0.5 * (chain.durations_s[k] + chain.durations_s[k + 1]);
    chain.knots[k].units_per_m = std::clamp(mean_s / spacing_s, 1.0 / kMostScaling, kMostScaling);
  }
}

}  // namespace

template <int D>
AdaptiveTrajectory<D> optimize_adaptively(TrajectoryObjective<D, 3>& objective,
                                          const KnotCandidates<D>& candidates, double travel_m,
                                          const OptimizerOptions& options) {
  AdaptiveTrajectory<D> result;
  KnotChain<D>& chain = result.chain;
  chain = choose_knots(objective, candidates);
  OptimizerOptions round_options = options;
  round_options.relative_cost = std::max(kRough, options.relative_cost);
  int evaluations = 0;
  for (int round = 0; round < kRounds; ++round) {
    scale_variables(chain);
    const auto map = std::make_shared<AdaptiveMap<D>>(chain.knots, travel_m);
    objective.set_knot_map(map);
    if (round == 0) chain.durations_s = paced(objective, chain.durations_s);
    result.found = optimize<D, 3>(objective, objective.initial(chain.durations_s), round_options);
    evaluations += result.found.evaluations;
    result.piece_evaluations += static_cast<long>(result.found.evaluations) * chain.pieces();
    if (result.found.variables.size() == 0) break;
    chain.knots = map->moved(result.found.variables.data());
    std::vector<double> penalties;
    for (int i = 0; i < chain.pieces(); ++i) {
      chain.durations_s[i] = result.found.curve.piece_duration(i);
      penalties.push_back(objective.penalty(i));
    }
    round_options.max_evaluations = options.max_evaluations - evaluations;
    if (round_options.max_evaluations <= 0 || options.should_stop()) break;
    KnotChain<D> refined = chain;
    const bool is_final = round > 0;
    const auto trial = try_knots(objective, chain, result.found.curve, penalties);
    if (!refine(refined, trial, kNegligible) && is_final) break;
    if (round + 1 < kRounds) chain = refined;
    round_options.relative_cost = options.relative_cost;
  }
  result.found.evaluations = evaluations;
  return result;
}

template AdaptiveTrajectory<2> optimize_adaptively(TrajectoryObjective<2, 3>&,
                                                   const KnotCandidates<2>&, double,
                                                   const OptimizerOptions&);
template AdaptiveTrajectory<3> optimize_adaptively(TrajectoryObjective<3, 3>&,
                                                   const KnotCandidates<3>&, double,
                                                   const OptimizerOptions&);

}  // namespace mocha
