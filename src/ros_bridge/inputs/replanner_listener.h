#pragma once

#include <mocha_ugv/PlannerStatus.h>
#include <mocha_ugv/ReplannerStatus.h>
#include <mocha_ugv/Trajectory.h>
#include <ros/node_handle.h>

#include <functional>
#include <string>

#include "planning/executive/goal_executive.h"

namespace mocha {

/// What the local replanner tells the global planner. Messages that are damaged are refused.
class ReplannerListener {
 public:
  struct Handlers {
    std::function<void(const Motion&)> follow;               ///< it follows this
    std::function<void()> request;                           ///< it asks for another plan
    std::function<void(const GoalExecutive::Report&)> hear;  ///< what it does, and why
  };

  ReplannerListener(ros::NodeHandle& node, Handlers handlers);

  /// Why it asked for another plan last; empty where it has not.
  const std::string& last_request() const { return last_request_; }
  int refused() const { return refused_; }

 private:
  void on_followed(const mocha_ugv::Trajectory& message);
  void on_request(const mocha_ugv::PlannerStatus& status);
  void on_status(const mocha_ugv::ReplannerStatus& message);
  void refuse(const char* topic, const std::string& why);

  Handlers handlers_;
  std::string last_request_;
  int refused_ = 0;
  ros::Subscriber followed_;
  ros::Subscriber requests_;
  ros::Subscriber statuses_;
};

}  // namespace mocha
