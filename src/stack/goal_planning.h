#pragma once

#include <memory>
#include <string>

#include "config/parameter_table.h"
#include "planning/executive/goal_executive.h"
#include "planning/global/global_planner.h"

namespace mocha {

/// The goal executive with the planner that it asks: goals and surroundings in, plans out.
class GoalPlanning {
 public:
  enum class StopNews { kNone, kStopped, kReset };

  /// `values` are those of config/global_planner.yaml; rank: see YieldPolicy.
  GoalPlanning(const RobotModel& robot, const ParameterTable& values, const Rank& rank);
  /// Counts for the goals that are there, too.
  void set_options(const ParameterTable& values);

  GoalExecutive& executive() { return executive_; }
  const GoalExecutive& executive() const { return executive_; }

  /// The emergency stops as they are now; `stops` counts them. With each new one the robot forgets
  /// where it was going: it does not set off again by itself.
  StopNews heed(bool stopped, int stops);
  bool stopped() const { return stopped_; }

  /// As GoalExecutive::step(); `scene` is empty while there is no map.
  GoalExecutive::Output step(double now_s, const RobotState& measured, const Motion& committed,
                             const SceneSource& scene);
  /// A plan to somewhere, whatever the executive is about.
  PlanResult plan(const PlanQuery& query, const SceneSource& scene) const;

 private:
  const RobotModel robot_;
  std::unique_ptr<const GlobalPlanner> planner_;
  GoalExecutive executive_;
  bool stopped_ = false;
  int heeded_ = 0;  // stops
};

}  // namespace mocha
