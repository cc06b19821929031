#include "planning/global/candidate_race.h"

#include <algorithm>
#include <atomic>
#include <limits>

#include "planning/candidates/parallel.h"

namespace mocha {
namespace {

/// The cost that a candidate has to stay below in order to be driven.
class CostToBeat {
 public:
  double get() const { return cost_.load(); }
  void lower_to(double cost) {
    double known = cost_.load();
    while (cost < known && !cost_.compare_exchange_weak(known, cost)) {
    }
  }

 private:
  std::atomic<double> cost_{std::numeric_limits<double>::infinity()};
};

}  // namespace

std::vector<PlanCandidate> race(const CandidatePlanner& planner, const PlanQuery& query,
                                const CandidateSeeds& seeds, const PlanningScene& scene,
                                const PlannerOptions& options,
                                const std::function<bool()>& should_stop) {
  const std::size_t count = seeds.list.size();
  std::vector<PlanCandidate> candidates(count);
  CostToBeat to_beat;
  const auto run = [&](std::size_t i) {
    const CandidateSeed& seed = seeds.list[i];
    const bool driven = seed.signature == seeds.driven;
    const double least_cost = planner.least_cost(seed);
    const auto cannot_win = [&] { return !driven && least_cost >= to_beat.get(); };
    PlanCandidate& candidate = candidates[i];
    candidate = planner.plan(query, seed, scene, [&] { return cannot_win() || should_stop(); });
    candidate.driven = driven;
    // An optimiser may leave its class.
    if (!candidate.motion.empty()) {
      candidate.signature = signature_of<2>(
          seeds.cuts, path_of(candidate.motion, query.start_time_s, planner.max_speed()));
    }
    if (candidate.reason == PlanReason::kBudgetExhausted && cannot_win()) {
      candidate.reason = PlanReason::kCannotWin;
      candidate.cost = std::max(candidate.cost, least_cost);
    }
    if (candidate.reason == PlanReason::kSolved)
      to_beat.lower_to(driven ? (1.0 - options.switch_margin) * candidate.cost : candidate.cost);
  };
  // Cheapest path first, so that what is to beat is known early.
  in_parallel(count, options.threads, run);
  return candidates;
}

}  // namespace mocha
