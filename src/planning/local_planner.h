#pragma once

#include <functional>
#include <vector>

#include "planning/local_optimizer.h"
#include "planning/local_plan.h"
#include "planning/local_rules.h"
#include "topology/space_time_ways.h"

namespace mocha {

/// What a search is doing.
enum class LocalStage { kFrontEnd, kOptimisation, kDone };

/// Section V: leaves a plan in order to avoid what moves, and comes back to it.
class LocalPlanner {
 public:
  /// Told when a stage begins, for whoever measures; called by several threads at once.
  using Watch = std::function<void(LocalStage)>;

  LocalPlanner(
      const RobotModel& robot, const LocalRules& rules, Watch watch = [](LocalStage) {});

  /// Tries what is driven first, then other ways.
  LocalPlan plan(const LocalQuery& query, const LocalScene& scene) const;
  /// What is driven, made to fit; other ways are not looked for. No candidate where nothing is
  /// driven.
  LocalPlan keep_on(const LocalQuery& query, const LocalScene& scene) const;
  /// Other ways too, among which that of what is driven has to be beaten by what a change of class
  /// is worth; against scene.moving.
  LocalPlan anew(const LocalQuery& query, const LocalScene& scene) const;
  /// On the ways of a plan for the same query that came to nothing, perhaps by a planner for a
  /// robot that may do less.
  LocalPlan again(const LocalQuery& query, const LocalScene& scene, const LocalPlan& failed) const;

 private:
  /// To come back to the plan at one place and time.
  struct Task {
    Return back;
    SpaceTimeQuery ways;
  };

  /// mu, but no less than to the anchor that is driven to: what is driven could not be told from
  /// other ways to a nearer one.
  double anchor_ahead_s(const LocalQuery& query) const;
  /// With anchors ever farther and arrivals ever later.
  std::vector<Task> tasks(const LocalQuery& query, const LocalScene& scene) const;
  Cuts<2> cuts_for(const std::vector<Task>& tasks, const LocalScene& scene) const;
  /// Past scene.moving; scene.expected is what else is proved of what comes out.
  LocalPlan search(const LocalQuery& query, const LocalScene& scene) const;
  LocalPlan along(const std::vector<SpaceTimeWay>& ways, const LocalQuery& query,
                  const LocalScene& scene, const Return& back) const;
  LocalPlan attempt(const LocalQuery& query, const LocalScene& scene, const Task& task,
                    const Cuts<2>& cuts) const;
  void select(const LocalQuery& query, const LocalScene& scene, const Return& back,
              LocalPlan& plan) const;

  const Watch watch_;
  const double max_speed_;
  const LocalRules rules_;
  const SpaceTimeRules space_time_rules_;
  const LocalOptimizer optimizer_;
};

}  // namespace mocha
