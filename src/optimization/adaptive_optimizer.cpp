#include "optimization/adaptive_optimizer.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "optimization/knot_refinement.h"
#include "optimization/pace.h"

namespace mocha {
namespace {

constexpr double kRough = 1e-3;        // fall of the cost at which the first search stops
constexpr double kNegligible = 1e-3;   // of the cost: estimated gains that are left out in all
constexpr int kRefinements = 3;        // at most, each with a search that is no rougher
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

/// One search after another, each from the curve of the one before.
template <int D>
class AdaptiveSearch {
 public:
  AdaptiveSearch(TrajectoryObjective<D, 3>& objective, double travel_m,
                 const OptimizerOptions& options)
      : objective_(objective), travel_m_(travel_m), options_(options) {}

  AdaptiveTrajectory<D> run(KnotChain<D> chain) {
    objective_.set_knot_map(std::make_shared<AdaptiveMap<D>>(chain.knots, travel_m_));
    chain.durations_s = paced(objective_, chain.durations_s);
    const double finest = options_.relative_cost;
    const double roughest = std::max(kRough, finest);
    search(std::move(chain), roughest);
    for (int round = 0; round < kRefinements && !has_ended(); ++round) {
      KnotChain<D> refined = result_.chain;
      const bool has_more = refine(refined, trial(), kNegligible);
      // What is left idle costs little; that alone is no reason to search again.
      if (round > 1 && !has_more) break;
      search(std::move(refined), round == 0 ? std::sqrt(roughest * finest) : finest);
    }
    return std::move(result_);
  }

 private:
  bool has_ended() const {
    return result_.found.variables.size() == 0 ||
           result_.found.evaluations >= options_.max_evaluations || options_.should_stop();
  }

  void search(KnotChain<D> chain, double relative_cost) {
    const int before = result_.found.evaluations;
    OptimizerOptions options = options_;
    options.relative_cost = relative_cost;
    options.max_evaluations -= before;
    scale_variables(chain);
    const auto map = std::make_shared<AdaptiveMap<D>>(chain.knots, travel_m_);
    objective_.set_knot_map(map);
    result_.found = optimize<D, 3>(objective_, objective_.initial(chain.durations_s), options);
    result_.piece_evaluations += static_cast<long>(result_.found.evaluations) * chain.pieces();
    result_.found.evaluations += before;
    if (result_.found.variables.size() > 0) {
      chain.knots = map->moved(result_.found.variables.data());
      for (int i = 0; i < chain.pieces(); ++i)
        chain.durations_s[i] = result_.found.curve.piece_duration(i);
    }
    result_.chain = std::move(chain);
  }

  TrialKnots<D> trial() {
    std::vector<double> penalties;
    for (int i = 0; i < result_.chain.pieces(); ++i) penalties.push_back(objective_.penalty(i));
    return try_knots(objective_, result_.chain, result_.found.curve, penalties);
  }

  TrajectoryObjective<D, 3>& objective_;
  const double travel_m_;
  const OptimizerOptions& options_;
  AdaptiveTrajectory<D> result_;
};

}  // namespace

template <int D>
AdaptiveTrajectory<D> optimize_adaptively(TrajectoryObjective<D, 3>& objective,
                                          const KnotCandidates<D>& candidates, double travel_m,
                                          const OptimizerOptions& options) {
  AdaptiveSearch<D> search(objective, travel_m, options);
  return search.run(choose_knots(objective, candidates));
}

template AdaptiveTrajectory<2> optimize_adaptively(TrajectoryObjective<2, 3>&,
                                                   const KnotCandidates<2>&, double,
                                                   const OptimizerOptions&);
template AdaptiveTrajectory<3> optimize_adaptively(TrajectoryObjective<3, 3>&,
                                                   const KnotCandidates<3>&, double,
                                                   const OptimizerOptions&);

}  // namespace mocha
