#include "planning/candidates/pipeline.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

#include "planning/candidates/parallel.h"

namespace mocha {
namespace {

constexpr double kSlowest = 4.0;      // times as long as optimised: slower motions are none
constexpr double kRepairable = 1.03;  // not worth another optimisation
constexpr double kSlowDownSlack = 1.001;

/// How many times as long a motion must take to keep the limit that it violates; 1 where that does
/// not help.
double slow_down(const Violation& violation) {
  const double excess = kSlowDownSlack * violation.value / violation.limit;
  switch (violation.term) {
    case ViolatedTerm::kSpeed:
    case ViolatedTerm::kZoneSpeed:
    case ViolatedTerm::kYawRate:
    case ViolatedTerm::kWheelSpeed:
      return excess;
    case ViolatedTerm::kAcceleration:
      return std::sqrt(excess);
    default:
      return 1.0;
  }
}

/// From rest to rest, a drive may take longer.
bool is_free_in_time(const DriveQuery& query) {
  return query.start.col(1).isZero() && !query.rejoin;
}

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

/// Slower than optimised by a factor, as the proof failed at the place, and dearer by what that
/// costs.
OptimizedDrive slowed(OptimizedDrive found, double factor, const Vector2& place,
                      const DurationCost& cost) {
  const double optimised_s = found.curve.duration();
  const double more = cost.value(factor * optimised_s) - cost.value(optimised_s);
  found.curve = found.curve.stretched(factor);
  found.cost += more;
  for (auto& [name, value] : found.terms) {
    if (name == "duration") value += more;
  }
  if (factor > kRepairable) found.fallbacks.push_back({FallbackKind::kSlowedDown, place});
  return found;
}

}  // namespace

bool CandidatePipeline::prove(const StartManeuver& start_maneuver, const OptimizedDrive& found,
                              PlanCandidate& candidate) const {
  candidate.cost = found.cost;
  candidate.parameterisation = found.parameterisation;
  candidate.fallbacks = found.fallbacks;
  candidate.terms = found.terms;
  if (!rules_.assemble(start_maneuver, found.curve, candidate)) return false;
  rules_.certify(candidate);
  return true;
}

void CandidatePipeline::climb(const Seed& seed, const StartManeuver& start_maneuver,
                              const std::function<bool()>& should_stop,
                              const std::function<bool(double)>& is_too_dear,
                              PlanCandidate& best) const {
  const DriveQuery query = rules_.drive(seed, start_maneuver);
  const EffortLadder ladder = rules_.ladder();
  Effort effort;
  for (int attempt = 1; attempt <= ladder.attempts && !should_stop(); ++attempt) {
    auto found = optimizer_.optimize_drive(query, obstacles_, effort, should_stop,
                                           ladder.most_work - best.work);
    if (seed.fallback) found.fallbacks.push_back(*seed.fallback);
    best.evaluations += found.evaluations;
    best.work += static_cast<double>(found.evaluations) * found.curve.pieces();
    PlanCandidate tried = best;
    if (found.curve.pieces() == 0 || !prove(start_maneuver, found, tried)) {
      if (!query.found_before || !std::exchange(effort.from_found, false)) return;
      continue;
    }
    const double cost = tried.cost;
    const double slower = is_free_in_time(query) ? slow_down(tried.violation) : 1.0;
    if (slower > 1.0 && slower <= (attempt == ladder.attempts ? kSlowest : kRepairable))
      prove(start_maneuver, slowed(found, slower, tried.violation.place, query.duration_cost),
            tried);
    const Violation violation = tried.violation;
    if (tried.met <= best.met) best = std::move(tried);
    if (best.met == rules_.wanted() || !rules_.may_be_mended(violation)) return;
    // A search whose evaluations are used up does not tell what the drive would cost.
    if (found.stop != StopReason::kBudget && is_too_dear(cost)) return;
    effort = raised(effort, violation, ladder.factor);
  }
}

PlanCandidate CandidatePipeline::optimise_and_certify(
    const Seed& seed, const std::function<bool()>& should_stop,
    const std::function<bool(double)>& is_too_dear) const {
  PlanCandidate best;
  best.signature = seed.signature;
  best.driven = seed.driven;
  best.path = seed.start_maneuvers.front().path;
  const auto is_over = [&, most_work = rules_.ladder().most_work] {
    return should_stop() || best.work >= most_work;
  };
  for (const StartManeuver& start_maneuver : seed.start_maneuvers) {
    climb(seed, start_maneuver, is_over, is_too_dear, best);
    if (best.met == rules_.wanted()) break;
  }
  if (best.met != RequirementName::kNone) {
    best.reason = PlanReason::kSolved;
  } else {
    best.reason = is_over() ? PlanReason::kBudgetExhausted : PlanReason::kNotCertified;
  }
  return best;
}

std::vector<PlanCandidate> CandidatePipeline::race(const std::vector<Seed>& seeds,
                                                   const SwitchRule& rule, int threads,
                                                   const std::function<bool()>& should_stop) const {
  std::vector<PlanCandidate> candidates(seeds.size());
  CostToBeat to_beat;
  // Cheapest path first, so that what is to beat is known early.
  in_parallel(seeds.size(), threads, [&](std::size_t i) {
    const Seed& seed = seeds[i];
    PlanCandidate& candidate = candidates[i];
    const auto is_too_dear = [&](double cost) { return !seed.driven && cost >= to_beat.get(); };
    const auto cannot_win = [&] { return is_too_dear(seed.least_cost); };
    candidate = optimise_and_certify(
        seed, [&] { return cannot_win() || should_stop(); }, is_too_dear);
    if (candidate.reason == PlanReason::kBudgetExhausted && cannot_win()) {
      candidate.reason = PlanReason::kCannotWin;
      candidate.cost = std::max(candidate.cost, seed.least_cost);
    }
    if (candidate.met == rules_.wanted())
      to_beat.lower_to(seed.driven ? rule.to_beat(candidate.cost) : candidate.cost);
  });
  return candidates;
}

}  // namespace mocha
