#include <diagnostic_updater/diagnostic_updater.h>
#include <mocha_ugv/PlanTrajectory.h>
#include <ros/ros.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "planning/driven_trail.h"
#include "planning/global_planner.h"
#include "planning/goal_queue.h"
#include "ros/commitment_source.h"
#include "ros/conversions.h"
#include "ros/goal_inputs.h"
#include "ros/live_parameters.h"
#include "ros/map_source.h"
#include "ros/parameters.h"
#include "ros/peer_source.h"
#include "ros/planner_outputs.h"
#include "ros/pose_source.h"
#include "ros/robot_identity.h"
#include "ros/run_node.h"
#include "ros/status_conversions.h"
#include "ros/step_loop.h"
#include "ros/transport.h"
#include "topology/map_terrain.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kMapBorder_m = 3.0;
constexpr double kSoonest_s = 0.2;  // between two plans, whoever asks
constexpr double kSamePlace_m = 0.5;
constexpr double kAfterEnd_s = 0.5;  // a plan that ended this long ago without arrival has failed

/// Finds the way: goals and maps in, plans out.
class GlobalPlannerNode {
 public:
  GlobalPlannerNode(ros::NodeHandle& node, const ParameterTable& values)
      : identity_(robot_identity()),
        model_(load_robot_model(config_path(""), values.text("robot_model"))),
        values_(values),
        planner_(std::make_unique<GlobalPlanner>(model_, PlannerRules::from(values))),
        goals_(GoalRules::from(values)),
        pose_(node, identity_, values.number("max_pose_age"), values.number("max_transform_age")),
        map_(node, identity_.map_frame),
        peers_(node, identity_.name, identity_.map_frame),
        committed_(node, identity_.name),
        outputs_(node, identity_, model_),
        followed_(node.subscribe("local_trajectory", 2, &GlobalPlannerNode::on_followed, this,
                                 at_once())),
        requests_(
            node.subscribe("replan_request", 10, &GlobalPlannerNode::on_request, this, at_once())),
        service_(node.advertiseService("plan", &GlobalPlannerNode::on_plan_service, this)),
        inputs_(node, identity_, pose_.transforms(),
                {[this](std::deque<Goal> goals) { take(std::move(goals)); },
                 [this](const std::string& why) { stop(why); }}),
        parameters_(values_, [this](const ParameterTable& changed) { apply(changed); }),
        loop_(node, identity_.name, values.number("period"), [this](ros::Time now) { step(now); }) {
    diagnostics_.setHardwareID(identity_.name);
    diagnostics_.add("planning", this, &GlobalPlannerNode::diagnose);
  }

 private:
  // --- what comes in ---

  /// What is driven instead of what was planned, around something that moves.
  void on_followed(const mocha_ugv::Trajectory& message) {
    if (goals_.empty() || goal_is_new_ || retreats_) return;
    try {
      Motion followed = from_message(message);
      const Vector2 end = followed.end_pose().position;
      if ((end - goals_.current().position).norm() < kSamePlace_m) plan_ = std::move(followed);
    } catch (const std::exception& error) {
      ++refused_;
      ROS_WARN_THROTTLE(1.0, "Refused a message on local_trajectory: %s", error.what());
    }
  }

  void on_request(const mocha_ugv::PlannerStatus& status) {
    requested_ = true;
    request_ = status.message;
  }

  void take(std::deque<Goal> goals) {
    goals_.set(std::move(goals), now_.toSec());
    begin_goal();
  }

  void begin_goal() {
    plan_ = Motion();
    retreats_ = false;
    goal_is_new_ = true;
    occupied_since_.reset();
  }

  void apply(const ParameterTable& values) {
    planner_ = std::make_unique<GlobalPlanner>(model_, PlannerRules::from(values));
    goals_.set_rules(GoalRules::from(values));
  }

  // --- what happens when ---

  void step(ros::Time now) {
    now_ = now;
    diagnostics_.update();
    const PoseReading reading = pose_.read(now);
    if (!reading.state) {
      if (!goals_.empty()) report(PlanReason::kNoPose, {}, reading.missing);
      return;
    }
    trail_.add(*reading.state);
    if (goals_.empty()) return;
    inputs_.feedback(*reading.state, now);
    switch (goals_.update(now.toSec(), *reading.state)) {
      case GoalQueue::Event::kAllReached:
        ROS_INFO("%s: reached its goal", identity_.name.c_str());
        inputs_.finish(true, "reached");
        return;
      case GoalQueue::Event::kReached:
        begin_goal();
        break;
      case GoalQueue::Event::kTimedOut:
        inputs_.finish(false, "no progress; last: " + outputs_.text());
        stop("no progress towards the goal");
        return;
      case GoalQueue::Event::kNone:
        break;
    }
    if (due()) plan();
  }

  bool due() const {
    const double since_s = (now_ - planned_at_).toSec();
    if (goal_is_new_) return true;
    const bool retreat_ends =
        retreats_ && now_.toSec() > plan_.end_time() - values_.number("planning_time");
    if (requested_ || retreat_ends) return since_s >= kSoonest_s;
    if (retreats_) return false;
    const bool has_plan = !plan_.empty() && now_.toSec() < plan_.end_time() + kAfterEnd_s;
    return since_s >= values_.number(has_plan ? "replan_period" : "retry_period");
  }

  void plan() {
    if (!map_.available()) {
      report(PlanReason::kNoMap, {}, "no map on " + ros::names::resolve("map") + " yet");
      return;
    }
    if (committed_.motion().empty()) {
      report(PlanReason::kNoPose, {}, "nothing is committed yet that a plan could start from");
      return;
    }
    PlanQuery query = query_to(goals_.current());
    if (!goal_is_new_ && !retreats_) query.driven = plan_;
    const PlanResult result = planner_->plan(query, scene(query), [] { return false; });
    const bool improvement = !goal_is_new_ && !requested_ && !retreats_ && !plan_.empty() &&
                             now_.toSec() < plan_.end_time() + kAfterEnd_s;
    planned_at_ = now_;
    requested_ = false;
    ++plans_made_;
    outputs_.show_candidates(result, goals_.current(), now_);
    if (improvement && (result.motion.empty() || !much_better(result.motion))) return;
    if (result.motion.empty()) {
      report(result.reason, result.violation, result.message);
      give_up_where_occupied(result);
      return;
    }
    goal_is_new_ = false;
    occupied_since_.reset();
    report(result.reason, result.violation, result.message);
    class_switches_ += result.switches_class;
    retreats_ = result.reason == PlanReason::kBackingOut;
    if (!retreats_) goals_.move_current(result.goal);
    adopt(result.motion);
  }

  PlanningScene scene(const PlanQuery& query) {
    PlanningScene scene;
    const Vector2 start = query.committed.at(query.start_time_s).pose.position;
    scene.terrain = std::make_shared<MapTerrain>(
        map_.field(DistanceField::Solid::kOccupied, {start, query.goal}, kMapBorder_m));
    scene.peers = peers_.obstacles();
    return scene;
  }

  bool much_better(const Motion& motion) const {
    const double remaining_s = plan_.end_time() - now_.toSec();
    return motion.end_time() < plan_.end_time() - values_.number("better_by") * remaining_s;
  }

  void give_up_where_occupied(const PlanResult& result) {
    goal_is_new_ = false;
    if (result.reason != PlanReason::kGoalOccupied) {
      occupied_since_.reset();
      return;
    }
    if (!occupied_since_) occupied_since_ = now_;
    if ((now_ - *occupied_since_).toSec() < values_.number("occupied_goal_timeout")) return;
    inputs_.finish(false, result.message);
    stop(result.message);
  }

  void stop(const std::string& why) {
    ROS_INFO("%s: stops: %s", identity_.name.c_str(), why.c_str());
    goals_.clear();
    if (committed_.motion().empty()) return;
    const double from_s =
        committed_.motion().switch_time(now_.toSec() + values_.number("planning_time"));
    adopt(Motion(from_s,
                 brake_along(committed_.motion(), from_s, 0.6 * model_.limits.max_acceleration)));
  }

  bool on_plan_service(mocha_ugv::PlanTrajectory::Request& request,
                       mocha_ugv::PlanTrajectory::Response& response) {
    const PlanResult result = plan_for(request);
    response.success = result.reason == PlanReason::kSolved;
    response.status =
        to_message(result.reason, result.violation, result.message, identity_.map_frame, now_);
    if (!result.motion.empty()) response.trajectory = outputs_.planned(result.motion, now_);
    for (const auto& candidate : result.candidates) {
      response.candidates.push_back(to_message(candidate, identity_.map_frame, now_));
    }
    return true;
  }

  PlanResult plan_for(const mocha_ugv::PlanTrajectory::Request& request) {
    PlanResult refusal;
    refusal.reason = PlanReason::kInvalidInput;
    const bool from_here = request.start.header.frame_id.empty();
    const auto goal = inputs_.to_goal(request.goal);
    const auto start = from_here ? std::nullopt : inputs_.to_goal(request.start);
    if (!goal || (!from_here && !start)) {
      refusal.message = "start or goal is not usable: " + inputs_.refusal();
      return refusal;
    }
    if (!map_.available() || (from_here && committed_.motion().empty())) {
      refusal.reason = map_.available() ? PlanReason::kNoPose : PlanReason::kNoMap;
      refusal.message = map_.available() ? "the robot's state is not known yet" : "no map yet";
      return refusal;
    }
    PlanQuery query = query_to(*goal);
    if (start) {
      query.start_time_s = now_.toSec();
      query.committed =
          Motion(now_.toSec(), {StandPhase{{start->position, start->yaw_rad.value_or(0.0)}, 0.1}});
      query.trail.clear();
    }
    return planner_->plan(query, scene(query), [] { return false; });
  }

  PlanQuery query_to(const Goal& goal) const {
    PlanQuery query;
    query.committed = committed_.motion();
    query.start_time_s =
        committed_.motion().switch_time(now_.toSec() + values_.number("planning_time"));
    query.goal = goal.position;
    query.goal_yaw_rad = goal.yaw_rad;
    query.trail = trail_.points();
    return query;
  }

  // --- what goes out ---

  void adopt(const Motion& motion) {
    plan_ = motion;
    outputs_.adopt(motion, now_);
  }

  void report(PlanReason reason, const Violation& violation, const std::string& text) {
    outputs_.report(reason, violation, text, now_);
  }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    const bool fine = goals_.empty() || outputs_.reason() == PlanReason::kSolved;
    status.summary(
        fine ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
        goals_.empty() ? "no goal" : to_text(outputs_.reason()) + (": " + outputs_.text()));
    status.add("plans made", plans_made_);
    status.add("plans adopted", outputs_.adopted());
    status.add("switches to another class of ways", class_switches_);
    status.add("last request", request_);
    status.add("parameter changes refused", parameters_.refused());
    status.add("messages refused", refused_ + committed_.refused() + inputs_.refused() +
                                       map_.refused() + peers_.refused() + pose_.refused());
  }

  const RobotIdentity identity_;
  const RobotModel model_;
  ParameterTable values_;
  std::unique_ptr<const GlobalPlanner> planner_;
  GoalQueue goals_;
  DrivenTrail trail_;
  PoseSource pose_;
  MapSource map_;
  PeerSource peers_;
  CommitmentSource committed_;
  PlannerOutputs outputs_;
  Motion plan_;
  ros::Time now_;
  ros::Time planned_at_;
  bool goal_is_new_ = false;
  bool requested_ = false;
  bool retreats_ = false;  // plan_ backs out; the way to the goal is to be found from its end
  std::optional<ros::Time> occupied_since_;
  std::string request_;
  int plans_made_ = 0;
  int class_switches_ = 0;
  int refused_ = 0;
  ros::Subscriber followed_;
  ros::Subscriber requests_;
  ros::ServiceServer service_;
  diagnostic_updater::Updater diagnostics_;
  GoalInputs inputs_;
  LiveParameters parameters_;
  StepLoop loop_;
};

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  return mocha::run_node<mocha::GlobalPlannerNode>(argc, argv, "global_planner");
}
