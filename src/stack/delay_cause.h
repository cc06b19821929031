#pragma once

#include <limits>
#include <utility>

#include "planning/executive/goal_executive.h"

namespace mocha {

/// Why a robot comes no nearer to its goal: which of its planners knows, and what that says.
class DelayCause {
 public:
  using Report = GoalExecutive::Report;

  /// What the global planner came to.
  void hear_planner(Report said) { planner_ = std::move(said); }
  /// What the local replanner says from now on.
  void hear_replanner(const Report& said, double now_s);

  /// With a plan, what the local replanner finds wrong with promising it, and for a little longer,
  /// as it tries again and again; else what the global planner came to.
  Report cause(bool has_plan, double now_s) const;

 private:
  Report planner_;
  Report complaint_;  // of the local replanner, the newest
  bool complains_ = false;
  double complained_until_s_ = -std::numeric_limits<double>::infinity();
};

}  // namespace mocha
