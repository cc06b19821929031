#include "ros_bridge/inputs/goal_inputs.h"

#include <tf2_geometry_msgs/tf2_geometry_msgs.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "ros_bridge/messages/conversions.h"

namespace mocha {

GoalInputs::GoalInputs(ros::NodeHandle& node, RobotIdentity robot,
                       const tf2::BufferCore& transforms, Handlers handlers)
    : robot_(std::move(robot)),
      transforms_(transforms),
      handlers_(std::move(handlers)),
      simple_goals_(node.subscribe("move_base_simple/goal", 2, &GoalInputs::on_simple_goal, this)),
      waypoints_(node.subscribe<nav_msgs::Path>(
          "waypoints", 2, [this](const nav_msgs::Path::ConstPtr& path) { on_list(*path, false); })),
      patrols_(node.subscribe<nav_msgs::Path>(
          "patrol", 2, [this](const nav_msgs::Path::ConstPtr& path) { on_list(*path, true); })),
      action_(node, "move_base", false) {
  action_.registerGoalCallback([this] { on_action_goal(); });
  action_.registerPreemptCallback([this] { on_action_cancel(); });
  action_.start();
}

std::optional<Goal> GoalInputs::to_goal(const geometry_msgs::PoseStamped& stamped) {
  try {
    geometry_msgs::PoseStamped pose = stamped;
    const auto& q = pose.pose.orientation;
    const bool any_heading = q.x == 0.0 && q.y == 0.0 && q.z == 0.0 && q.w == 0.0;
    if (any_heading) pose.pose.orientation = quaternion_of(0.0);
    if (!pose.header.frame_id.empty() && pose.header.frame_id != robot_.map_frame) {
      const auto to_map =
          transforms_.lookupTransform(robot_.map_frame, pose.header.frame_id, ros::Time(0));
      tf2::doTransform(pose, pose, to_map);
    }
    const Pose in_map = from_message(pose.pose);
    if (!in_map.position.allFinite() || !std::isfinite(in_map.yaw_rad)) {
      throw std::invalid_argument("is not finite");
    }
    Goal goal{in_map.position, std::nullopt};
    if (!any_heading) goal.yaw_rad = in_map.yaw_rad;
    return goal;
  } catch (const std::exception& error) {
    refuse(error.what());
    return std::nullopt;
  }
}

std::optional<Goal> GoalInputs::accept(const geometry_msgs::PoseStamped& pose) {
  const auto goal = to_goal(pose);
  const std::string why = goal ? handlers_.refusal(*goal) : "";
  if (why.empty()) return goal;
  refuse(why);
  return std::nullopt;
}

void GoalInputs::refuse(const std::string& why) {
  ++refused_;
  refusal_ = "goal: " + why;
  ROS_WARN_THROTTLE(1.0, "%s: refused a message on %s", robot_.name.c_str(), refusal_.c_str());
}

void GoalInputs::on_simple_goal(const geometry_msgs::PoseStamped& pose) {
  const auto goal = accept(pose);
  if (!goal) return;
  finish(false, "preempted by a goal on move_base_simple/goal");
  handlers_.take({*goal}, false);
}

void GoalInputs::on_list(const nav_msgs::Path& path, bool patrols) {
  std::deque<Goal> goals;
  for (geometry_msgs::PoseStamped pose : path.poses) {
    if (pose.header.frame_id.empty()) pose.header.frame_id = path.header.frame_id;
    const auto goal = accept(pose);
    if (!goal) return;
    goals.push_back(*goal);
  }
  if (patrols && goals.size() == 1) return refuse("a patrol needs at least two waypoints");
  finish(false, "preempted by a list of waypoints");
  if (goals.empty()) {
    handlers_.stop("the list of waypoints is empty");
  } else {
    handlers_.take(std::move(goals), patrols);
  }
}

void GoalInputs::on_action_goal() {
  const auto goal = accept(action_.acceptNewGoal()->target_pose);
  if (goal) {
    handlers_.take({*goal}, false);
    return;
  }
  action_.setAborted({}, "the goal is not usable: " + refusal_);
  handlers_.stop("the new goal is not usable: " + refusal_);
}

void GoalInputs::on_action_cancel() {
  action_.setPreempted({}, "cancelled");
  if (!action_.isNewGoalAvailable()) handlers_.stop("cancelled");
}

void GoalInputs::finish(bool reached, const std::string& text) {
  if (!action_.isActive()) return;
  if (reached) {
    action_.setSucceeded({}, text);
  } else {
    action_.setAborted({}, text);
  }
}

void GoalInputs::feedback(const RobotState& state, ros::Time now) {
  if (!action_.isActive()) return;
  move_base_msgs::MoveBaseFeedback feedback;
  feedback.base_position.header.stamp = now;
  feedback.base_position.header.frame_id = robot_.map_frame;
  feedback.base_position.pose = to_message(state.pose);
  action_.publishFeedback(feedback);
}

}  // namespace mocha
