#pragma once

#include <mocha_ugv/Trajectory.h>
#include <ros/node_handle.h>

#include <memory>
#include <string>
#include <vector>

#include "planning/replanner/local_replanner.h"
#include "ros_bridge/runtime/robot_identity.h"
#include "stack/planning_effort.h"
#include "world/moving/moving_obstacle.h"

namespace mocha {

/// What a local replanner tells the others and rviz: what is followed instead of the global plan as
/// `local_trajectory`, and predictions and detours as `local_markers`.
class LocalOutputs {
 public:
  using Predictions = std::vector<std::shared_ptr<const MovingObstacle>>;

  struct Counts {
    int solved = 0;    ///< local plans
    int followed = 0;  ///< of these, for they could be promised
    int switches = 0;  ///< to another class before the plan was met again
  };

  /// Predictions are drawn `horizon_s` ahead.
  LocalOutputs(ros::NodeHandle& node, const RobotIdentity& identity, const RobotModel& model,
               double horizon_s);

  /// What a step decided, which took `took_s`, and the plan that is followed since.
  void show(const LocalReplanner::Output& output, double took_s, const Motion& plan,
            const Predictions& predictions, ros::Time now);
  /// Nothing is known to be going on.
  void clear(ros::Time now);

  const Counts& counts() const { return counts_; }
  /// What local plans took; each the whole step.
  const PlanningRecord& record() const { return record_; }
  /// What the newest local plan said.
  const std::string& message() const { return local_.message; }

 private:
  void publish(const Motion& plan, ros::Time now);
  void draw(const Motion& plan, const Predictions& predictions, ros::Time now);

  const RobotIdentity identity_;
  const double radius_m_;
  const Braking braking_;
  const double horizon_s_;
  ros::Publisher plans_;
  ros::Publisher drawings_;
  Counts counts_;
  PlanningRecord record_;
  LocalPlan local_;  // the newest
  ros::Time planned_at_;
  ros::Time drawn_at_;
  bool shows_ = false;
};

}  // namespace mocha
