#pragma once

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <mocha_ugv/Candidates.h>
#include <nav_msgs/Path.h>
#include <ros/node_handle.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rviz_panel/background_calls.h"
#include "rviz_panel/robot_words.h"

namespace mocha {

/// The names of the robots whose nodes are on a ROS master, in order. Waits for the master.
std::vector<std::string> robots_on_master();

/// One robot, as somebody at a screen deals with it: what it says, and what it is told.
class RobotClient {
 public:
  /// Switches of a robot: services of the type std_srvs/SetBool.
  enum class Switch { kPause, kEmergencyStop, kFleetEmergencyStop };

  /// `calls` must outlive this. `say` hears what became of a call, on the thread of `calls`.
  RobotClient(std::string name, BackgroundCalls& calls, std::function<void(std::string)> say);

  const std::string& name() const { return name_; }
  RobotWords words(ros::Time now) const { return words_of(news_, now); }
  /// The classes of paths of the newest plan.
  std::vector<mocha_ugv::Candidate> candidates() const {
    return candidates_ ? candidates_->candidates : std::vector<mocha_ugv::Candidate>();
  }

  /// What its planner says in /diagnostics.
  void hear(const diagnostic_msgs::DiagnosticStatus& status, ros::Time now);

  void drive_to(const geometry_msgs::PoseStamped& goal) { goals_.publish(goal); }
  /// One goal after the other; an empty list ends whatever it drives to.
  void drive_along(const nav_msgs::Path& waypoints) { waypoints_.publish(waypoints); }
  /// The same, again and again.
  void patrol(const nav_msgs::Path& waypoints) { patrols_.publish(waypoints); }
  void turn(Switch which, bool on);

 private:
  std::string name_;
  BackgroundCalls& calls_;
  std::function<void(std::string)> say_;
  RobotNews news_;
  std::optional<mocha_ugv::Candidates> candidates_;
  ros::NodeHandle node_;
  std::vector<ros::Subscriber> subscribers_;
  ros::Publisher goals_;
  ros::Publisher waypoints_;
  ros::Publisher patrols_;
};

}  // namespace mocha
