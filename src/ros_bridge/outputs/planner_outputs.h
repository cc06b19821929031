#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <mocha_ugv/Candidate.h>
#include <mocha_ugv/PlanTrajectory.h>
#include <mocha_ugv/Trajectory.h>
#include <ros/ros.h>

#include <cstdint>
#include <string>
#include <vector>

#include "planning/candidates/plan_kind.h"
#include "planning/candidates/plan_result.h"
#include "planning/executive/goal_queue.h"
#include "ros_bridge/runtime/robot_identity.h"
#include "stack/planning_effort.h"
#include "world/robot_model.h"

namespace mocha {

/// What a global planner tells the others and rviz: the plan as `global_trajectory` and
/// `global_path`, every candidate with its costs, and `planner_status`.
class PlannerOutputs {
 public:
  PlannerOutputs(ros::NodeHandle& node, const RobotIdentity& identity, const RobotModel& model);

  /// The plan that is to be driven from now on; an empty one: there is nothing to drive to.
  void adopt(const Motion& motion, ros::Time now, PlanKind kind = PlanKind::kFree);
  /// What the service `plan` answers; nothing is adopted.
  mocha_ugv::PlanTrajectory::Response answer(const PlanResult& result, ros::Time now) const;

  void show_candidates(const PlanResult& result, const Goal& goal, ros::Time now);

  /// Publishes the status, which names the goal of several; news are logged as well, but for a
  /// success.
  void report(PlanReason reason, const Violation& violation, const std::string& text,
              const GoalQueue::Progress& progress, ros::Time now);
  /// How many plans there were, what they took, and what they fell back on.
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  /// The last report.
  PlanReason reason() const { return reason_; }
  const std::string& text() const { return text_; }

 private:
  mocha_ugv::Trajectory planned(const Motion& motion, ros::Time now) const;
  std::vector<mocha_ugv::Candidate> messages(const std::vector<PlanCandidate>& candidates,
                                             ros::Time now) const;

  const RobotIdentity identity_;
  const double radius_m_;
  const Braking braking_;
  ros::Publisher plans_;
  ros::Publisher candidates_;
  ros::Publisher statuses_;
  ros::Publisher paths_;
  ros::Publisher drawings_;
  PlanningRecord record_;
  std::uint32_t adopted_ = 0;  // plans; the sequence of the newest
  PlanReason reason_ = PlanReason::kNoGoal;
  std::string text_;
};

}  // namespace mocha
