#pragma once

#include <mocha_ugv/PlanTrajectory.h>
#include <nav_msgs/GetPlan.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <atomic>
#include <functional>
#include <string>

#include "stack/plan_runner.h"

namespace mocha {

/// The services `plan` and, as move_base has it, `move_base/make_plan`: plan on a thread of their
/// own, beside the node's callbacks.
class PlanService {
 public:
  using Request = mocha_ugv::PlanTrajectory::Request;
  using Response = mocha_ugv::PlanTrajectory::Response;
  using Work = PlanRunner::Work;

  struct Handlers {
    /// What is to be done for a request.
    std::function<Work(const Request&)> prepare;
    std::function<Response(const PlanResult&)> respond;
  };

  /// There is nothing to be done, as nothing can be planned.
  static Work refusal(PlanReason reason, const std::string& why);

  /// The handlers are called from the node's callback queue.
  PlanService(ros::NodeHandle& node, Handlers handlers);
  /// Ends what is under way, without an answer.
  ~PlanService() { ends_ = true; }

 private:
  bool on_request(Request& request, Response& response);
  /// The path alone; empty where there is no plan. A tolerance is not asked for: where the goal is
  /// occupied, plans lead near by.
  bool on_make_plan(nav_msgs::GetPlan::Request& request, nav_msgs::GetPlan::Response& response);

  const Handlers handlers_;
  std::atomic<bool> ends_{false};
  ros::CallbackQueue queue_;
  ros::ServiceServer service_;
  ros::ServiceServer path_service_;
  ros::AsyncSpinner spinner_;
};

}  // namespace mocha
