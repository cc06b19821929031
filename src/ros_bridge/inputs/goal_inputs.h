#pragma once

#include <actionlib/server/simple_action_server.h>
#include <geometry_msgs/PoseStamped.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <nav_msgs/Path.h>
#include <ros/node_handle.h>
#include <tf2/buffer_core.h>

#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "control/robot_state.h"
#include "planning/executive/goal_queue.h"
#include "ros_bridge/runtime/robot_identity.h"

namespace mocha {

/// Every way to give a robot a goal: the action `move_base`, the topics `move_base_simple/goal`,
/// `waypoints` and `patrol`, a list that begins anew at its end. The newest one counts. A
/// quaternion of zeros means any heading.
class GoalInputs {
 public:
  struct Handlers {
    std::function<void(std::deque<Goal>, bool patrols)> take;  ///< new goals, in their order
    std::function<void(const std::string&)> stop;              ///< no goal any more, and why
    /// Why a goal is not taken now; empty where it is.
    std::function<std::string(const Goal&)> refusal;
  };

  /// `transforms` must outlive this.
  GoalInputs(ros::NodeHandle& node, RobotIdentity robot, const tf2::BufferCore& transforms,
             Handlers handlers);

  /// In the map frame; nothing, counted and said, for what is not usable.
  std::optional<Goal> to_goal(const geometry_msgs::PoseStamped& pose);

  /// Ends the action, where the goal came from one.
  void finish(bool reached, const std::string& text);
  void feedback(const RobotState& state, ros::Time now);

  int refused() const { return refused_; }
  const std::string& refusal() const { return refusal_; }

 private:
  void on_simple_goal(const geometry_msgs::PoseStamped& pose);
  void on_list(const nav_msgs::Path& path, bool patrols);
  void on_action_goal();
  void on_action_cancel();
  /// As to_goal(), unless the goal is not taken now.
  std::optional<Goal> accept(const geometry_msgs::PoseStamped& pose);
  void refuse(const std::string& why);

  RobotIdentity robot_;
  const tf2::BufferCore& transforms_;
  Handlers handlers_;
  int refused_ = 0;
  std::string refusal_;
  ros::Subscriber simple_goals_;
  ros::Subscriber waypoints_;
  ros::Subscriber patrols_;
  actionlib::SimpleActionServer<move_base_msgs::MoveBaseAction> action_;
};

}  // namespace mocha
