#pragma once

#include <optional>

#include "planning/local_planner.h"
#include "planning/promise_builder.h"

namespace mocha {

/// Looks for ways around what moves, and remembers the plan that a swerve comes back to (V). It
/// says what could be driven; whether it can be promised, and is taken, is for the caller.
class Swerving {
 public:
  /// What the robot is at. `join_s` is the switch time of `committed` at which a swerve may leave
  /// it; `follows_plan`: at that time it is the plan.
  struct Situation {
    double now_s;
    double join_s;
    const Motion& committed;
    const Motion& plan;
    bool follows_plan;
  };

  Swerving(const RobotModel& robot, const LocalRules& rules, const LocalPlanner::Watch& watch);

  /// Past what the plan meets. Nothing where it is too soon to try again, or no plan is near enough
  /// to come back to; else what the search found, which may be no motion.
  std::optional<LocalPlan> around(const Situation& at, const PromiseScene& scene);

  /// On the ways of a search that came to nothing just now, but more abruptly, and past the most
  /// likely course of what moves.
  LocalPlan harder(const Situation& at, const PromiseScene& scene, const LocalPlan& failed) const;

  /// A swerve is as slow as it had to be when it began. Looks from time to time whether it could be
  /// sooner back on its plan by now; nothing where it could not.
  std::optional<LocalPlan> sooner(const Situation& at, const PromiseScene& scene);

  /// `taken` is driven in the place of `left`.
  void take(double now_s, const Motion& left, const LocalPlan& taken);
  /// There is another plan.
  void forget() { route_ = Motion(); }

 private:
  std::optional<LocalQuery> way_back(const Situation& at) const;
  LocalScene local(double now_s, const PromiseScene& scene) const;

  PromiseBuilder builder_;
  LocalPlanner planner_;
  LocalPlanner hard_planner_;  // the same, for accelerations that only an emergency calls for
  Motion route_;               // the plan that the swerve comes back to; empty: there is none
  double rejoins_s_ = 0.0;     // absolute
  double anchor_s_ = 0.0;      // time of route_ at which it is there; 0: it is not
  double tried_s_ = 0.0;
  double not_before_s_ = 0.0;  // it is tried again
};

}  // namespace mocha
