#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "planning/candidates/drive_optimizer.h"
#include "planning/candidates/selection.h"
#include "planning/candidates/start_maneuver.h"

namespace mocha {

/// One class of paths, and how to begin on it.
struct Seed {
  /// At least one; what is to be preferred comes first.
  std::vector<StartManeuver> start_maneuvers;
  /// When the path is at its points, from 0, increasing; empty: as early as the limits allow.
  std::vector<double> times_s;
  Signature signature;
  double least_cost;                                ///< of every candidate of this class, proved
  bool driven;                                      ///< the class of what is being driven
  std::optional<Fallback> fallback = std::nullopt;  ///< of the search for the path
};

/// How often a drive is optimised until it is certified, and how much harder each time.
struct EffortLadder {
  int attempts;
  double factor;  ///< of the weight of what is violated, from attempt to attempt
  /// Evaluations of single pieces, of all attempts together.
  double most_work = std::numeric_limits<double>::infinity();
};

/// What global and local planning do each in their own way.
class CandidateRules {
 public:
  virtual ~CandidateRules() = default;

  /// What is to be met. A candidate that does is tried no further.
  virtual RequirementName wanted() const = 0;
  virtual EffortLadder ladder() const = 0;
  /// The drive that is to be found after a start maneuver.
  virtual DriveQuery drive(const Seed& seed, const StartManeuver& start_maneuver) const = 0;
  /// Sets the motion of a candidate, with what comes before and after the drive, and counts what
  /// that costs. False where that is no motion, or none that is worth certifying.
  virtual bool assemble(const StartManeuver& start_maneuver, const PlanarPath& drive,
                        PlanCandidate& candidate) const = 0;
  /// Sets what the motion of a candidate meets, and how it violates what is wanted.
  virtual void certify(PlanCandidate& candidate) const = 0;
  /// Whether more effort may mend a violation.
  virtual bool may_be_mended(const Violation& violation) const = 0;
};

/// From seeds to candidates: optimise, certify, try harder. Global and local planning instantiate
/// it with their rules.
class CandidatePipeline {
 public:
  /// All must live longer.
  CandidatePipeline(const DriveOptimizer& optimizer, const ObstacleField<2>& obstacles,
                    const CandidateRules& rules)
      : optimizer_(optimizer), obstacles_(obstacles), rules_(rules) {}

  /// Tries the start maneuvers of a seed in turn, each with rising effort, until what is wanted is
  /// met, the work is used up, or `should_stop`. A drive that `is_too_dear` where its search
  /// came to its end is not tried harder: as a rule, more effort makes it dearer. Returns the last
  /// of the best.
  PlanCandidate optimise_and_certify(
      const Seed& seed, const std::function<bool()>& should_stop,
      const std::function<bool(double)>& is_too_dear = [](double) { return false; }) const;

  /// Does so with all seeds, on up to `threads` threads; a candidate for each, in the same order.
  ///
  /// A candidate is stopped (kCannotWin) as soon as its least cost is not below what another one
  /// that meets what is wanted costs, and is too dear where its own cost is not. So the cheapest is
  /// the same however many threads there are, unless more effort would have made another one
  /// cheaper. The candidate of the class that is driven runs to its end, as the others are measured
  /// against it. `should_stop` may be called by several threads at once.
  std::vector<PlanCandidate> race(const std::vector<Seed>& seeds, const SwitchRule& rule,
                                  int threads, const std::function<bool()>& should_stop) const;

 private:
  /// The attempts after one start maneuver.
  void climb(const Seed& seed, const StartManeuver& start_maneuver,
             const std::function<bool()>& should_stop,
             const std::function<bool(double)>& is_too_dear, PlanCandidate& best) const;
  /// Makes a candidate's motion of what was found, and certifies it; false where that is none.
  bool prove(const StartManeuver& start_maneuver, const OptimizedDrive& found,
             PlanCandidate& candidate) const;

  const DriveOptimizer& optimizer_;
  const ObstacleField<2>& obstacles_;
  const CandidateRules& rules_;
};

}  // namespace mocha
