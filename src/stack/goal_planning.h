#pragma once

#include <memory>
#include <string>

#include "config/parameter_table.h"
#include "planning/executive/goal_executive.h"
#include "planning/global/global_planner.h"
#include "stack/delay_cause.h"
#include "stack/plan_runner.h"

namespace mocha {

/// The goal executive with the planner that it asks: goals and surroundings in, plans out, and what
/// keeps the robot from its goal, whichever planner knows it.
class GoalPlanning {
 public:
  enum class StopNews { kNone, kStopped, kReset };

  /// `values` are those of config/global_planner.yaml; name and priority: see PassingPolicy;
  /// `handover_s`: what a plan needs until the robot is bound to it; `map_name`: where the map
  /// comes from, in messages to people. The runner must live longer.
  GoalPlanning(const RobotModel& robot, const ParameterTable& values, const std::string& name,
               int priority, double handover_s, PlanRunner& runner, std::string map_name = "map");
  /// Counts for the goals that are there, too.
  void set_options(const ParameterTable& values);

  GoalExecutive& executive() { return executive_; }
  const GoalExecutive& executive() const { return executive_; }

  /// The emergency stops as they are now; `stops` counts them. With each new one the robot forgets
  /// where it was going: it does not set off again by itself.
  StopNews heed(bool stopped, int stops);
  bool stopped() const { return stopped_; }

  /// What the local replanner says from now on.
  void hear_replanner(const GoalExecutive::Report& said, double now_s) {
    cause_.hear_replanner(said, now_s);
  }

  /// As GoalExecutive::step(), but the report is there where it is news, and says what keeps the
  /// robot from its goal. `scene` is empty while there is no map; plans call it wherever the runner
  /// makes them.
  GoalExecutive::Output step(double now_s, const RobotState& measured, const Motion& committed,
                             const SceneSource& scene);
  /// The same while the pose is not known: `missing` says what it lacks.
  GoalExecutive::Output wait_for_pose(double now_s, const std::string& missing);
  /// Makes a plan to somewhere, whatever the executive is about; on any thread.
  PlanRunner::Work work_on(const PlanQuery& query, const SceneSource& scene) const;

 private:
  GoalExecutive::Report cause(bool has_plan, double now_s) const;
  void explain(bool has_plan, double now_s, GoalExecutive::Output& output);

  const RobotModel robot_;
  const double handover_s_;
  const std::string map_name_;
  PlanRunner& runner_;
  std::shared_ptr<const GlobalPlanner> planner_;
  GoalExecutive executive_;
  DelayCause cause_;
  GoalExecutive::Report said_;
  const double planning_time_s_;
  double goal_timeout_s_;
  bool stopped_ = false;
  int heeded_ = 0;  // stops
};

}  // namespace mocha
