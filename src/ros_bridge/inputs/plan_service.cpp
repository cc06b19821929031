#include "ros_bridge/inputs/plan_service.h"

#include <utility>

#include "ros_bridge/runtime/callback_queue.h"

namespace mocha {

PlanService::PlanService(ros::NodeHandle& node, Handlers handlers)
    : handlers_(std::move(handlers)), spinner_(1, &queue_) {
  ros::NodeHandle own(node);
  own.setCallbackQueue(&queue_);
  service_ = own.advertiseService("plan", &PlanService::on_request, this);
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

}  // namespace mocha
