#include "stack/planning_effort.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mocha {
namespace {

constexpr std::size_t kKept = 200;  // plans

}  // namespace

PlanningEffort PlanningEffort::of(const PlanResult& result) {
  PlanningEffort effort;
  effort.took_s = result.took_s;
  effort.classes = static_cast<int>(result.candidates.size());
  for (const PlanCandidate& candidate : result.candidates) {
    effort.evaluations += candidate.evaluations;
    if (candidate.selected) effort.parameterisation = candidate.parameterisation;
  }
  return effort;
}

void PlanningRecord::add(const PlanningEffort& effort) {
  last_ = effort;
  ++plans_;
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
