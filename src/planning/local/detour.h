#pragma once

#include <optional>

#include "planning/local/local_planner.h"

namespace mocha {

/// Looks for detours around what moves, paper V, and remembers the plan that a detour comes back
/// to. It says what could be driven; whether it can be promised, and is taken, is for the caller.
class Detour {
 public:
  /// Where a detour begins. `join_s` is the switch time of `committed` at which it may leave that;
  /// `follows_plan`: at that time the committed motion is the plan.
  struct Start {
    double now_s;
    double join_s;
    const Motion& committed;
    const Motion& plan;
    bool follows_plan;
  };

  Detour(const RobotModel& robot, const LocalOptions& options, const LocalPlanner::Watch& watch);

  /// Past what the plan meets. Nothing where it is too soon to try again, or no plan is near enough
  /// to come back to; else what the search found, which may be no motion.
  std::optional<LocalPlan> around(const Start& start, const LocalScene& scene);

  /// On the paths of a search that came to nothing just now, within the limits of an emergency.
  LocalPlan harder(const Start& start, const LocalScene& scene, const LocalPlan& failed) const;

  /// A detour is as slow as it had to be when it began. Looks from time to time whether the robot
  /// could be back on its plan sooner by now; nothing where it could not.
  std::optional<LocalPlan> sooner(const Start& start, const LocalScene& scene);

  /// `taken` is driven in the place of `left`.
  void take(double now_s, const Motion& left, const LocalPlan& taken);
  /// There is another plan.
  void forget() { route_ = Motion(); }

 private:
  std::optional<LocalQuery> way_back(const Start& start) const;

  LocalPlanner planner_;
  Motion route_;                 // the plan that the detour comes back to; empty: there is none
  double rejoins_s_ = 0.0;       // absolute
  double rejoin_point_s_ = 0.0;  // time of route_ at which it is there; 0: it is not
  double tried_s_ = 0.0;
  double not_before_s_ = 0.0;  // it is tried again
};

}  // namespace mocha
