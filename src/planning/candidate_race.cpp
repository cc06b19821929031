#include "planning/candidate_race.h"

#include <algorithm>
#include <atomic>
#include <limits>

#include "planning/parallel.h"

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
                                const Approaches& approaches, const PlanningScene& scene,
                                const PlannerRules& rules,
                                const std::function<bool()>& should_stop) {
  const std::size_t count = approaches.list.size();
  std::vector<PlanCandidate> candidates(count);
  CostToBeat to_beat;
  const auto run = [&](std::size_t i) {
    const Approach& approach = approaches.list[i];
    const bool driven = approach.signature == approaches.driven;
    const double least_cost = planner.least_cost(approach);
    const auto cannot_win = [&] { return !driven && least_cost >= to_beat.get(); };
    PlanCandidate& candidate = candidates[i];
    candidate = planner.plan(query, approach, scene, [&] { return cannot_win() || should_stop(); });
    candidate.driven = driven;
    // An optimiser may leave its class.
    if (!candidate.motion.empty()) {
      candidate.signature = signature_of<2>(
          approaches.cuts, path_of(candidate.motion, query.start_time_s, planner.max_speed()));
    }
    if (candidate.reason == PlanReason::kBudgetExhausted && cannot_win()) {
      candidate.reason = PlanReason::kCannotWin;
      candidate.cost = std::max(candidate.cost, least_cost);
    }
    if (candidate.reason == PlanReason::kSolved)
      to_beat.lower_to(driven ? (1.0 - rules.switch_margin) * candidate.cost : candidate.cost);
  };
  // Cheapest way first, so that what is to beat is known early.
  in_parallel(count, rules.threads, run);
  return candidates;
}

}  // namespace mocha
