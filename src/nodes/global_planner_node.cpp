#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>

#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "planning/candidates/path_clearance.h"
#include "ros_bridge/inputs/battery_listener.h"
#include "ros_bridge/inputs/committed_trajectory_source.h"
#include "ros_bridge/inputs/emergency_stop_listener.h"
#include "ros_bridge/inputs/goal_inputs.h"
#include "ros_bridge/inputs/map_source.h"
#include "ros_bridge/inputs/passing_messages.h"
#include "ros_bridge/inputs/peer_source.h"
#include "ros_bridge/inputs/plan_service.h"
#include "ros_bridge/inputs/pose_source.h"
#include "ros_bridge/inputs/replanner_listener.h"
#include "ros_bridge/inputs/zone_source.h"
#include "ros_bridge/messages/conversions.h"
#include "ros_bridge/messages/status_conversions.h"
#include "ros_bridge/outputs/planner_outputs.h"
#include "ros_bridge/runtime/callback_queue.h"
#include "ros_bridge/runtime/live_parameters.h"
#include "ros_bridge/runtime/parameters.h"
#include "ros_bridge/runtime/robot_identity.h"
#include "ros_bridge/runtime/run_node.h"
#include "ros_bridge/runtime/step_loop.h"
#include "ros_bridge/runtime/transport.h"
#include "stack/freed_memory.h"
#include "stack/goal_planning.h"
#include "stack/local_replanning.h"
#include "stack/plan_worker.h"

namespace mocha {
namespace {

constexpr double kMapBorder_m = 3.0;

double steady_now_s() { return ros::SteadyTime::now().toSec(); }

/// Finds the way: goals and maps in, plans out.
class GlobalPlannerNode {
 public:
  GlobalPlannerNode(ros::NodeHandle& node, const ParameterTable& values)
      : identity_(robot_identity()),
        model_(own_robot_model(values)),
        values_(values),
        map_(node, identity_.map_frame),
        worker_({steady_now_s, [this] { call_soon([this] { step(loop_.now()); }); },
                 !ros::Time::isSimTime()}),
        planning_(model_, values, identity_.name,
                  neighbour_parameters("trajectory_broadcaster").integer("priority"),
                  handover_s(neighbour_parameters("local_replanner")), worker_,
                  ros::names::resolve("map")),
        stop_(node, [this] { heed_stop(); }),
        battery_(node,
                 LowBattery::Options::from(
                     values, neighbour_parameters("base_driver").number("low_battery")),
                 {[this](const std::string& why) { inputs_.finish(false, why), drop(why); },
                  [this](const Goal& goal) { take({goal}, false); }}),
        pose_(node, identity_, values.number("max_pose_age"), values.number("max_transform_age")),
        peers_(node, identity_.name, identity_.map_frame),
        committed_(node, identity_.name),
        outputs_(node, identity_, model_),
        passing_(node, identity_,
                 [this](const PassingMessage& message) {
                   executive_.hear(message, ros::Time::now().toSec());
                 }),
        replanner_(node, {[this](const Motion& motion) { executive_.follow(motion); },
                          [this] { executive_.request(); },
                          [this](const GoalExecutive::Report& report) {
                            planning_.hear_replanner(report, ros::Time::now().toSec());
                          }}),
        pauses_(node.advertiseService("pause", &GlobalPlannerNode::on_pause, this)),
        inputs_(node, identity_, pose_.transforms(),
                {[this](std::deque<Goal> goals, bool patrols) { take(std::move(goals), patrols); },
                 [this](const std::string& why) { stop(why); },
                 [this](const Goal& goal) {
                   const std::string why = refusal();
                   return why.empty() ? zones_.refusal({goal}) : why;
                 }}),
        zones_(node, identity_.map_frame, [this](bool were_known) { heed_zones(were_known); }),
        parameters_(values_,
                    [this](const ParameterTable& changed) { planning_.set_options(changed); }),
        loop_(node, identity_.name, values.number("period"), [this](ros::Time now) { step(now); }),
        service_(node,
                 {[this](const auto& request) { return work_on(request); },
                  [this](const PlanResult& result) { return outputs_.answer(result, now_); }}) {
    diagnostics_.setHardwareID(identity_.name);
    diagnostics_.add("planning", this, &GlobalPlannerNode::diagnose);
    ROS_INFO("%s: passes gaps of %.2f m, turns on the spot in %.2f m", identity_.name.c_str(),
             passable_gap_m(model_), turning_room_m(model_));
  }

 private:
  // --- what comes in ---

  void take(std::deque<Goal> goals, bool patrols) {
    executive_.take(std::move(goals), committed_.motion(), now_.toSec(), patrols);
  }

  /// Goals in a zone that is not to be entered are given up, plans are made anew; a robot in such a
  /// zone that has no goal leaves it.
  void heed_zones(bool may_leave) {
    const std::string why = zones_.refusal(executive_.goals().left());
    if (!why.empty()) stop("the goal is given up: " + why);
    executive_.request();
    const bool rests = executive_.idle() && executive_.state() != ExecutiveState::kPaused;
    if (may_leave && rests && !stop_.stopped() && !zones_.exit().empty())
      take({Goal{zones_.exit().back(), std::nullopt}}, false);
  }

  bool on_pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
    if (request.data) {
      executive_.pause();
      outputs_.adopt(Motion(), now_);
    } else {
      executive_.resume();
      battery_.go_on();
      if (executive_.idle()) report(PlanReason::kNoGoal, {}, "is not paused any more");
    }
    response.success = true;
    response.message = to_text(executive_.state());
    return true;
  }

  // --- what happens when ---

  void step(ros::Time now) {
    now_ = now;
    diagnostics_.update();
    heed_stop();
    battery_.step(now, executive_.idle(), stop_.stopped());
    const bool looked_for_answer = go_on();
    if (worker_.busy() || (looked_for_answer && executive_.awaits_plan())) {
      loop_.hold();
    } else {
      loop_.release();
    }
  }

  /// False where it cannot do anything.
  bool go_on() {
    const PoseReading reading = pose_.read(now_);
    if (!reading.state) {
      show(planning_.wait_for_pose(now_.toSec(), reading.missing));
      return false;
    }
    if (!executive_.idle()) inputs_.feedback(*reading.state, now_);
    const auto before = executive_.goals().progress();
    show(planning_.step(now_.toSec(), *reading.state, committed_.motion(), scenes()));
    if (!executive_.idle() && !(executive_.goals().progress() == before))
      ROS_INFO("%s: reached %s", identity_.name.c_str(), before.words().c_str());
    return true;
  }

  void heed_stop() {
    using StopNews = GoalPlanning::StopNews;
    const StopNews news = planning_.heed(stop_.stopped(), stop_.stops());
    if (news == StopNews::kStopped) {
      const std::string why =
          stop_.stopped() ? stop_.reason() : "emergency stop, which is reset by now";
      inputs_.finish(false, why);
      outputs_.adopt(Motion(), now_);
      report(PlanReason::kEmergencyStop, {}, why);
    } else if (news == StopNews::kReset) {
      report(PlanReason::kNoGoal, {}, "the emergency stop is reset");
    }
  }

  /// The newest map whenever it is asked for, on any thread, with the team-mates of now. Empty
  /// while there is no map.
  SceneSource scenes() {
    if (!map_.available()) return {};
    return [this, peers = peers_.obstacles(),
            slow = zones_.speed_zones(model_)](const std::vector<Vector2>& places) {
      const auto unseen = [this, places] {
        return map_.field(DistanceField::Solid::kOccupiedOrUnknown, places, kMapBorder_m);
      };
      return PlanningScene{map_.static_map(places, kMapBorder_m), peers, unseen, slow};
    };
  }

  /// The way to the charger is not for those to stop whose goals are refused.
  void stop(const std::string& why) {
    if (!refusal().empty()) return;
    inputs_.finish(false, why);
    drop(why);
  }

  void drop(const std::string& why) {
    executive_.drop();
    outputs_.adopt(Motion(), now_);
    report(PlanReason::kNoGoal, {}, why);
  }

  std::string refusal() const { return stop_.stopped() ? stop_.reason() : battery_.reason(); }

  PlanService::Work work_on(const PlanService::Request& request) {
    const bool from_here = request.start.header.frame_id.empty();
    const auto goal = inputs_.to_goal(request.goal);
    const auto start = from_here ? std::nullopt : inputs_.to_goal(request.start);
    if (!goal || (!from_here && !start))
      return PlanService::refusal(PlanReason::kInvalidInput,
                                  "start or goal is not usable: " + inputs_.refusal());
    const std::string kept_out = zones_.refusal({*goal});
    if (!kept_out.empty())
      return PlanService::refusal(PlanReason::kGoalOccupied, "the goal: " + kept_out);
    if (!map_.available()) return PlanService::refusal(PlanReason::kNoMap, "no map yet");
    if (from_here && committed_.motion().empty())
      return PlanService::refusal(PlanReason::kNoPose, "the robot's state is not known yet");
    const double now_s = now_.toSec();
    const Motion from =
        start ? Motion(now_s, {StandPhase{{start->position, start->yaw_rad.value_or(0.0)}, 0.1}})
              : committed_.motion();
    PlanQuery query = executive_.query_to(*goal, from, now_s);
    if (start) query.start_time_s = now_s;
    query.time_limit_s = std::numeric_limits<double>::infinity();  // nobody waits to drive
    return planning_.work_on(query, scenes());
  }

  // --- what goes out ---

  void show(const GoalExecutive::Output& output) {
    if (output.planned) {
      outputs_.show_candidates(output.planned->result, output.planned->goal, now_);
      class_switches_ += output.plan && output.planned->result.switches_class;
    }
    if (output.report) {
      const auto& [reason, violation, text] = *output.report;
      report(reason, violation, text);
    }
    for (const PassingMessage& message : output.messages) passing_.send(message, now_);
    finish(output.ending);
    if (output.plan) outputs_.adopt(*output.plan, now_, output.kind);
  }

  void finish(GoalExecutive::Ending ending) {
    if (ending == GoalExecutive::Ending::kNone) return;
    if (ending == GoalExecutive::Ending::kReached) {
      ROS_INFO("%s: reached its goal", identity_.name.c_str());
      battery_.arrive();
      inputs_.finish(true, "reached");
      return;
    }
    inputs_.finish(false, outputs_.text());
    ROS_WARN("%s: gives its goal up: %s", identity_.name.c_str(), outputs_.text().c_str());
  }

  void report(PlanReason reason, const Violation& violation, const std::string& text) {
    outputs_.report(reason, violation, text, executive_.goals().progress(), now_);
  }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    const bool rests = executive_.idle() || executive_.state() == ExecutiveState::kPaused;
    const bool fine = !planning_.stopped() && (rests || outputs_.reason() == PlanReason::kSolved);
    const std::string doing =
        rests ? to_text(executive_.state()) : to_text(outputs_.reason()) + (": " + outputs_.text());
    status.summary(fine ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
                   planning_.stopped() ? stop_.reason() : doing);
    if (battery_.low()) status.mergeSummary(DiagnosticStatus::WARN, battery_.reason());
    status.add("state", to_text(executive_.state()));
    status.add("passes gaps of (m)", passable_gap_m(model_));
    status.add("turns on the spot in (m)", turning_room_m(model_));
    outputs_.diagnose(status);
    status.add("switches to another class of paths", class_switches_);
    status.add("last request", replanner_.last_request());
    parameters_.diagnose(status);
    status.add("messages refused", replanner_.refused() + committed_.refused() + inputs_.refused() +
                                       map_.refused() + peers_.refused() + pose_.refused() +
                                       passing_.refused() + zones_.refused());
  }

  const RobotIdentity identity_;
  const RobotModel model_;
  ParameterTable values_;
  MapSource map_;
  PlanWorker worker_;  // uses the map
  GoalPlanning planning_;
  GoalExecutive& executive_ = planning_.executive();
  EmergencyStopListener stop_;
  BatteryListener battery_;
  PoseSource pose_;
  PeerSource peers_;
  CommittedTrajectorySource committed_;
  PlannerOutputs outputs_;
  PassingMessages passing_;
  ros::Time now_;
  int class_switches_ = 0;
  ReplannerListener replanner_;
  ros::ServiceServer pauses_;
  diagnostic_updater::Updater diagnostics_;
  GoalInputs inputs_;
  ZoneSource zones_;
  LiveParameters parameters_;
  StepLoop loop_;
  PlanService service_;
};

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  mocha::keep_freed_memory();
  return mocha::run_node<mocha::GlobalPlannerNode>(argc, argv, "global_planner");
}
