#pragma once

#include <deque>
#include <map>
#include <vector>

#include "planning/candidates/plan_result.h"

namespace mocha {

/// What a plan took.
struct PlanningEffort {
  double took_s = 0.0;
  int classes = 0;      ///< of paths
  int evaluations = 0;  ///< of trajectories, for all classes
  Parameterisation parameterisation = Parameterisation::kNone;  ///< of what was selected
  std::vector<Fallback> fallbacks;                              ///< the same

  static PlanningEffort of(const Selection& selection, double took_s);
};

/// How often plans fell back on something, and where last.
struct FallbackCount {
  int plans = 0;
  Vector2 place = Vector2::Zero();  ///< [m] map frame
  bool in_last_plan = false;
};

/// What the last plans took.
class PlanningRecord {
 public:
  void add(const PlanningEffort& effort);

  /// All zero before the first.
  const PlanningEffort& last() const { return last_; }
  int plans() const { return plans_; }
  /// Of all plans, what there was.
  const std::map<FallbackKind, FallbackCount>& fallbacks() const { return fallbacks_; }
  /// The time that this share of the last 200 plans did not exceed [s]: 0.5 for the median, 1 for
  /// the longest; 0 before the first.
  double quantile_s(double share) const;

 private:
  PlanningEffort last_;
  int plans_ = 0;
  std::map<FallbackKind, FallbackCount> fallbacks_;
  std::deque<double> times_s_;
};

}  // namespace mocha
