#pragma once

#include <limits>
#include <string>
#include <utility>

#include "planning/executive/goal_executive.h"

namespace mocha {

/// Why a robot comes no nearer to its goal: which of its planners knows, and what that says.
class DelayCause {
 public:
  using Report = GoalExecutive::Report;

  /// What the global planner came to.
  void hear_planner(Report said) { planner_ = std::move(said); }
  /// How long it planned, where that was measured, and how long it may.
  void hear_planning_time(double took_s, double allowed_s);
  /// What the local replanner says from now on.
  void hear_replanner(const Report& said, double now_s);

  /// With a plan, what the local replanner finds wrong with promising it, and for a little longer,
  /// as it tries again and again, and whether the plan came too late; else what the global planner
  /// came to.
  Report cause(bool has_plan, double now_s) const;

 private:
  Report planner_;
  Report complaint_;      // of the local replanner, the newest
  std::string lateness_;  // of the newest plan, in words
  bool complains_ = false;
  double complained_until_s_ = -std::numeric_limits<double>::infinity();
};

}  // namespace mocha
