#pragma once

#include <functional>
#include <vector>

#include "planning/candidates/drive_optimizer.h"
#include "planning/local/local_options.h"
#include "planning/local/local_rules.h"
#include "topology/space_time/space_time_paths.h"

namespace mocha {

/// What a search is doing.
enum class LocalStage { kFrontEnd, kOptimisation, kDone };

/// Section V: leaves a plan in order to avoid what moves, and comes back to it.
class LocalPlanner {
 public:
  /// Told when a stage begins, for measurements; called by several threads at once.
  using Watch = std::function<void(LocalStage)>;

  LocalPlanner(
      const RobotModel& robot, const LocalOptions& options, Watch watch = [](LocalStage) {});

  /// Tries what is driven first, then other paths; where nothing keeps clear of what moves with the
  /// confidence that is asked for, past its likely course. `query.wanted` is ignored.
  LocalPlan plan(const LocalQuery& query, const LocalScene& scene) const;
  /// What is driven, made to fit; other paths are not looked for. No candidate where nothing is
  /// driven.
  LocalPlan keep_on(const LocalQuery& query, const LocalScene& scene) const;
  /// Other paths too, among which that of what is driven has to be beaten by what a change of class
  /// is worth.
  LocalPlan anew(const LocalQuery& query, const LocalScene& scene) const;
  /// On the paths of a plan for the same query that came to nothing, wanted less.
  LocalPlan again(const LocalQuery& query, const LocalScene& scene, const LocalPlan& failed) const;

 private:
  /// To come back to the plan at one place and time.
  struct Task {
    Return back;
    SpaceTimeQuery paths;
  };

  const MotionLimits& limits_of(const LocalQuery& query) const {
    return *requirements_[query.wanted].limits;
  }
  /// mu, but no less than to the rejoin point that is driven to: what is driven could not be told
  /// from other paths to a nearer one.
  double rejoin_ahead_s(const LocalQuery& query) const;
  /// With rejoin points ever farther and arrivals ever later.
  std::vector<Task> tasks(const LocalQuery& query, const LocalScene& scene) const;
  Cuts<2> cuts_for(const std::vector<Task>& tasks, const LocalScene& scene) const;
  std::vector<MovingThing> moving(const LocalQuery& query, const LocalScene& scene) const;
  LocalPlan search(const LocalQuery& query, const LocalScene& scene) const;
  LocalPlan along(std::vector<SpaceTimePath> paths, const LocalQuery& query,
                  const LocalScene& scene, const Return& back) const;
  LocalPlan attempt(const LocalQuery& query, const LocalScene& scene, const Task& task,
                    const Cuts<2>& cuts) const;
  /// The winner of the candidates, as a plan.
  void finish(const LocalQuery& query, const LocalScene& scene, const Return& back,
              LocalPlan& plan) const;

  const Watch watch_;
  const Requirements requirements_;
  const Footprint footprint_;
  const LocalOptions options_;
  const SpaceTimeOptions space_time_options_;
  const DriveOptimizer optimizer_;
};

}  // namespace mocha
