#include "ros_bridge/outputs/planner_outputs.h"

#include <mocha_ugv/Candidates.h>
#include <mocha_ugv/PlannerStatus.h>
#include <nav_msgs/Path.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

#include "ros_bridge/messages/conversions.h"
#include "ros_bridge/messages/status_conversions.h"
#include "ros_bridge/outputs/effort_diagnostics.h"
#include "ros_bridge/rviz/candidate_drawing.h"
#include "ros_bridge/rviz/markers.h"

namespace mocha {
namespace {

constexpr double kPathStep_s = 0.1;  // of what is drawn

/// What a person wants to know of a plan.
std::string summary(const PlanResult& result) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(1);
  if (result.reason != PlanReason::kSolved) {
    text << "no plan: " << to_text(result.reason) << ": " << result.message;
    return text.str();
  }
  const auto certified =
      std::count_if(result.candidates.begin(), result.candidates.end(),
                    [](const PlanCandidate& each) { return each.reason == PlanReason::kSolved; });
  text << "reaches (" << result.goal.x() << ", " << result.goal.y()
       << "): " << result.motion.length_m() << " m in "
       << result.motion.end_time() - result.motion.start_time()
       << " s; classes of paths: " << result.candidates.size() << ", certified: " << certified
       << "; " << result.message;
  return text.str();
}

}  // namespace

PlannerOutputs::PlannerOutputs(ros::NodeHandle& node, const RobotIdentity& identity,
                               const RobotModel& model)
    : identity_(identity),
      radius_m_(model.footprint.circumscribed_radius_m()),
      braking_(model.braking()),
      plans_(node.advertise<mocha_ugv::Trajectory>("global_trajectory", 2, true)),
      candidates_(node.advertise<mocha_ugv::Candidates>("candidates", 2, true)),
      statuses_(node.advertise<mocha_ugv::PlannerStatus>("planner_status", 10, true)),
      paths_(node.advertise<nav_msgs::Path>("global_path", 2, true)),
      drawings_(node.advertise<visualization_msgs::MarkerArray>("planner_markers", 2, true)) {}

mocha_ugv::Trajectory PlannerOutputs::planned(const Motion& motion, ros::Time now) const {
  mocha_ugv::Trajectory message;
  message.header.stamp = now;
  message.header.frame_id = identity_.map_frame;
  message.state = mocha_ugv::Trajectory::PLANNED;
  message.agent = identity_.name;
  message.sequence = adopted_;
  message.footprint_radius = radius_m_;
  to_message(braking_, message);
  to_message(motion, message);
  return message;
}

std::vector<mocha_ugv::Candidate> PlannerOutputs::messages(
    const std::vector<PlanCandidate>& candidates, ros::Time now) const {
  std::vector<mocha_ugv::Candidate> messages;
  for (const PlanCandidate& candidate : candidates)
    messages.push_back(to_message(candidate, identity_.map_frame, now));
  return messages;
}

mocha_ugv::PlanTrajectory::Response PlannerOutputs::answer(const PlanResult& result,
                                                           ros::Time now) const {
  mocha_ugv::PlanTrajectory::Response response;
  response.success = result.reason == PlanReason::kSolved;
  response.message = summary(result);
  response.status =
      to_message(result.reason, result.violation, result.message, identity_.map_frame, now);
  if (!result.motion.empty()) response.trajectory = planned(result.motion, now);
  response.candidates = messages(result.candidates, now);
  return response;
}

void PlannerOutputs::adopt(const Motion& motion, ros::Time now, PlanKind kind) {
  ++adopted_;
  mocha_ugv::Trajectory message = planned(motion, now);
  if (kind == PlanKind::kInTurn) message.state = mocha_ugv::Trajectory::IN_TURN;
  plans_.publish(message);
  paths_.publish(to_path(motion, identity_.map_frame, kPathStep_s));
}

void PlannerOutputs::show_candidates(const PlanResult& result, const Goal& goal, ros::Time now) {
  record_.add(PlanningEffort::of(result, result.took_s));
  mocha_ugv::Candidates message;
  message.header.stamp = now;
  message.header.frame_id = identity_.map_frame;
  Drawing drawing(identity_.map_frame, now);
  message.candidates = messages(result.candidates, now);
  draw_candidates("candidates", result.candidates, drawing);
  drawing.add_goal(identity_.name, goal.position, goal.yaw_rad);
  candidates_.publish(message);
  drawings_.publish(drawing.markers());
}

void PlannerOutputs::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  status.add("plans adopted", adopted_);
  diagnose_effort(record_, status);
}

void PlannerOutputs::report(PlanReason reason, const Violation& violation, const std::string& what,
                            const GoalQueue::Progress& progress, ros::Time now) {
  const std::string goal = progress.words();
  const std::string text = goal.empty() ? what : goal + ": " + what;
  const bool news = reason != reason_ || text != text_;
  reason_ = reason;
  text_ = text;
  mocha_ugv::PlannerStatus status = to_message(reason, violation, text, identity_.map_frame, now);
  status.waypoint = progress.goal;
  status.waypoints = progress.goals;
  status.lap = progress.lap;
  status.effort = to_message(record_);
  statuses_.publish(status);
  if (!news || reason == PlanReason::kSolved) return;
  const std::string words = identity_.name + ": " + to_text(reason) + ": " + text;
  if (reason == PlanReason::kNoGoal || reason == PlanReason::kPaused) {
    ROS_INFO("%s", words.c_str());
  } else {
    ROS_WARN_THROTTLE(2.0, "%s", words.c_str());
  }
}

}  // namespace mocha
