#include "ros_bridge/inputs/plan_service.h"

#include <utility>

#include "ros_bridge/messages/conversions.h"
#include "ros_bridge/runtime/callback_queue.h"
#include "ros_bridge/rviz/markers.h"

namespace mocha {
namespace {

constexpr double kPathStep_s = 0.1;

}  // namespace

PlanService::PlanService(ros::NodeHandle& node, Handlers handlers)
    : handlers_(std::move(handlers)), spinner_(1, &queue_) {
  ros::NodeHandle own(node);
  own.setCallbackQueue(&queue_);
  service_ = own.advertiseService("plan", &PlanService::on_request, this);
  path_service_ = own.advertiseService("move_base/make_plan", &PlanService::on_make_plan, this);
  spinner_.start();
}

PlanService::Work PlanService::refusal(PlanReason reason, const std::string& why) {
  PlanResult result;
  result.reason = reason;
  result.message = why;
  return [result](const auto&) { return result; };
}

bool PlanService::on_request(Request& request, Response& response) {
  const auto ends = [this] { return ends_ || !ros::ok(); };
  // By value: they may be called when nobody waits any more.
  const auto work =
      call_and_wait<Work>([this, request] { return handlers_.prepare(request); }, ends);
  if (!work) return false;
  const PlanResult result = (*work)(ends);
  const auto answer =
      call_and_wait<Response>([this, result] { return handlers_.respond(result); }, ends);
  if (!answer) return false;
  response = *answer;
  return true;
}

bool PlanService::on_make_plan(nav_msgs::GetPlan::Request& request,
                               nav_msgs::GetPlan::Response& response) {
  Request question;
  question.start = request.start;
  question.goal = request.goal;
  Response answer;
  if (!on_request(question, answer)) return false;
  response.plan.header = answer.status.header;
  if (answer.success)
    response.plan =
        to_path(from_message(answer.trajectory), answer.status.header.frame_id, kPathStep_s);
  return true;
}

}  // namespace mocha
