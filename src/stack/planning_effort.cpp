#include "stack/planning_effort.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mocha {
namespace {

constexpr std::size_t kKept = 200;  // plans

}  // namespace

PlanningEffort PlanningEffort::of(const Selection& selection, double took_s) {
  PlanningEffort effort;
  effort.took_s = took_s;
  effort.classes = static_cast<int>(selection.candidates.size());
  for (const PlanCandidate& candidate : selection.candidates) {
    effort.evaluations += candidate.evaluations;
    if (!candidate.selected) continue;
    effort.parameterisation = candidate.parameterisation;
    effort.fallbacks = candidate.fallbacks;
  }
  return effort;
}

void PlanningRecord::add(const PlanningEffort& effort) {
  last_ = effort;
  ++plans_;
  for (auto& [kind, count] : fallbacks_) count.in_last_plan = false;
  for (const Fallback& fallback : effort.fallbacks) {
    FallbackCount& count = fallbacks_[fallback.kind];
    count = {count.plans + 1, fallback.place, true};
  }
  times_s_.push_back(effort.took_s);
  if (times_s_.size() > kKept) times_s_.pop_front();
}

double PlanningRecord::quantile_s(double share) const {
  if (times_s_.empty()) return 0.0;
  std::vector<double> sorted(times_s_.begin(), times_s_.end());
  std::sort(sorted.begin(), sorted.end());
  const double rank = std::ceil(share * static_cast<double>(sorted.size())) - 1.0;
  return sorted[static_cast<std::size_t>(std::max(0.0, rank))];
}

}  // namespace mocha
