#include <diagnostic_updater/diagnostic_updater.h>
#include <mocha_ugv/Lease.h>
#include <mocha_ugv/PlannerStatus.h>
#include <mocha_ugv/ReplannerStatus.h>
#include <mocha_ugv/Settlement.h>
#include <mocha_ugv/Trajectory.h>
#include <ros/ros.h>

#include <set>
#include <stdexcept>
#include <string>

#include "ros_bridge/inputs/emergency_stop_listener.h"
#include "ros_bridge/inputs/map_source.h"
#include "ros_bridge/inputs/peer_source.h"
#include "ros_bridge/inputs/pose_source.h"
#include "ros_bridge/inputs/prediction_source.h"
#include "ros_bridge/inputs/zone_source.h"
#include "ros_bridge/messages/committed_trajectory_conversions.h"
#include "ros_bridge/messages/conversions.h"
#include "ros_bridge/messages/status_conversions.h"
#include "ros_bridge/outputs/effort_diagnostics.h"
#include "ros_bridge/outputs/local_outputs.h"
#include "ros_bridge/runtime/parameters.h"
#include "ros_bridge/runtime/robot_identity.h"
#include "ros_bridge/runtime/run_node.h"
#include "ros_bridge/runtime/step_loop.h"
#include "ros_bridge/runtime/transport.h"
#include "stack/freed_memory.h"
#include "stack/local_replanning.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

constexpr double kMapBorder_m = 2.0;

std::set<FallbackKind> in_last_plan(const PlanningRecord& record) {
  std::set<FallbackKind> kinds;
  for (const Fallback& each : record.last().fallbacks) kinds.insert(each.kind);
  return kinds;
}

/// Promises what the global planner planned and makes detours around what moves: plans and
/// predictions in, proposals and leases out.
class LocalReplannerNode {
 public:
  LocalReplannerNode(ros::NodeHandle& node, const ParameterTable& values)
      : identity_(robot_identity()),
        model_(own_robot_model(values)),
        max_prediction_age_s_(values.number("max_prediction_age")),
        prediction_horizon_(values.number("prediction_horizon")),
        replanning_(model_, values,
                    Reach::from(neighbour_parameters("trajectory_broadcaster"), model_,
                                values.number("horizon"))
                        .promise_m,
                    {ros::names::resolve("map"), ros::names::resolve("fleet/trajectories"),
                     ros::names::resolve("predicted_obstacles")}),
        stop_(node),
        pose_(node, identity_, values.number("max_pose_age"), values.number("max_transform_age")),
        map_(node, identity_.map_frame),
        peers_(node, identity_.name, identity_.map_frame),
        zones_(node, identity_.map_frame),
        predictions_(node, identity_.map_frame),
        risk_(RiskOptions::from(values, model_)),
        local_(node, identity_, model_, values.number("prediction_horizon")),
        proposals_(node.advertise<mocha_ugv::Trajectory>("proposed_trajectory", 10)),
        leases_(node.advertise<mocha_ugv::Lease>("lease", 10)),
        requests_(node.advertise<mocha_ugv::PlannerStatus>("replan_request", 10)),
        statuses_(node.advertise<mocha_ugv::ReplannerStatus>("replanner_status", 10, true)),
        plans_(
            node.subscribe("global_trajectory", 2, &LocalReplannerNode::on_plan, this, at_once())),
        commitments_(node.subscribe("committed_trajectory", 10, &LocalReplannerNode::on_committed,
                                    this, at_once())),
        settlements_(
            node.subscribe("settlement", 10, &LocalReplannerNode::on_settlement, this, at_once())),
        loop_(node, identity_.name, values.number("period"), [this](ros::Time now) { step(now); }) {
    diagnostics_.setHardwareID(identity_.name);
    diagnostics_.add("promises", this, &LocalReplannerNode::diagnose);
    diagnostics_.add("detours", this, &LocalReplannerNode::diagnose_detours);
  }

 private:
  void on_plan(const mocha_ugv::Trajectory& message) {
    try {
      const bool in_turn = message.state == mocha_ugv::Trajectory::IN_TURN;
      replanning_.set_plan(message.phases.empty() ? Motion() : from_message(message),
                           in_turn ? PlanKind::kInTurn : PlanKind::kFree);
      if (replanning_.step_is_due()) step(ros::Time::now());
    } catch (const std::exception& error) {
      refuse("global_trajectory", error.what());
    }
  }

  void on_committed(const mocha_ugv::Trajectory& message) {
    try {
      replanning_.set_committed({message.epoch, message.sequence}, from_message(message));
    } catch (const std::exception& error) {
      refuse("committed_trajectory", error.what());
    }
  }

  void on_settlement(const mocha_ugv::Settlement& settlement) {
    replanning_.hear(answer_from_message(settlement));
    if (replanning_.step_is_due()) step(ros::Time::now());
  }

  void refuse(const std::string& topic, const std::string& why) {
    ++refused_messages_;
    ROS_WARN_THROTTLE(1.0, "Refused a message on %s: %s", topic.c_str(), why.c_str());
  }

  void step(ros::Time now) {
    now_ = now;
    diagnostics_.update();
    const ros::SteadyTime begun = ros::SteadyTime::now();
    const auto output = replanning_.step(now.toSec(), knowledge(now));
    const double took_s = (ros::SteadyTime::now() - begun).toSec();
    if (output.scene)
      local_.show(output, took_s, replanning_.replanner().plan(), output.scene->confident, now);
    else
      local_.clear(now);
    if (output.row == Row::kLastResort)
      ROS_ERROR_THROTTLE(1.0, "%s: %s", identity_.name.c_str(), output.message.c_str());
    if (output.proposal) propose(now, *output.proposal);
    if (output.lease) renew(now, *output.lease);
    report(now, output);
    if (output.request_plan) {
      requests_.publish(
          to_message(output.reason, output.violation, output.message, identity_.map_frame, now));
    }
  }

  LocalKnowledge knowledge(ros::Time now) {
    const PoseReading reading = pose_.read(now);
    LocalKnowledge known;
    if (stop_.stopped()) known.stop = stop_.reason();
    known.measured = reading.state;
    known.no_pose = reading.missing;
    known.map_age_s = map_.age_s(now);
    known.fleet_age_s = peers_.age_s(now);
    known.prediction_age_s = predictions_.age_s(now);
    known.sensor_fault = predictions_.sensor_fault();
    known.scene = [this, now](const Vector2& here) { return scene(now, here); };
    return known;
  }

  LocalScene scene(ros::Time now, const Vector2& here) {
    LocalScene scene =
        local_scene(map_.static_map({here}, kMapBorder_m),
                    map_.field(DistanceField::Solid::kOccupiedOrUnknown, {here}, kMapBorder_m));
    scene.peers = peers_.obstacles();
    scene.speed_zones = zones_.speed_zones(model_);
    const Predictions& predictions = predictions_.newest();
    confidence_ = confidence_of_each(predictions, here, risk_);
    scene.confident = confident_discs(predictions, confidence_, risk_);
    scene.likely = likely_discs(predictions);
    scene.predicted_until_s = (now + prediction_horizon_).toSec();
    return scene;
  }

  void propose(ros::Time now, const ProposedMotion& proposal) {
    mocha_ugv::Trajectory message;
    message.header.stamp = now;
    message.header.frame_id = identity_.map_frame;
    message.state =
        proposal.emergency ? mocha_ugv::Trajectory::EMERGENCY : mocha_ugv::Trajectory::PROPOSED;
    message.agent = identity_.name;
    message.sequence = proposal.sequence;
    message.footprint_radius = model_.footprint.circumscribed_radius_m();
    to_message(model_.braking(), message);
    to_message(proposal.motion, message);
    proposals_.publish(message);
  }

  void renew(ros::Time now, const Lease& renewed) {
    mocha_ugv::Lease lease;
    lease.header.stamp = now;
    lease.epoch = renewed.id.epoch;
    lease.sequence = renewed.id.sequence;
    lease.valid_until = ros::Time(renewed.end_s);
    leases_.publish(lease);
  }

  void report(ros::Time now, const LocalReplanner::Output& output) {
    const std::set<FallbackKind> fallbacks = in_last_plan(local_.record());
    const bool news = output.row != row_ || output.reason != reason_ || output.message != text_ ||
                      fallbacks != fallbacks_;
    fallbacks_ = fallbacks;
    row_ = output.row;
    reason_ = output.reason;
    text_ = output.message;
    if (!news) return;
    mocha_ugv::PlannerStatus status =
        to_message(reason_, output.violation, text_, identity_.map_frame, now);
    status.effort = to_message(local_.record());
    statuses_.publish(to_message(row_, status));
    if (!text_.empty())
      ROS_INFO_THROTTLE(1.0, "%s: %s: %s", identity_.name.c_str(), to_text(reason_), text_.c_str());
  }

  void diagnose_detours(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    const double age_s = predictions_.age_s(now_);
    const auto things = predictions_.newest().things.size();
    const bool known = age_s <= max_prediction_age_s_;
    status.summary(known ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
                   known ? "things that move: " + std::to_string(things)
                         : "no usable word on predicted_obstacles");
    const LocalOutputs::Counts& counts = local_.counts();
    status.add("things predicted", things);
    status.addf("confidence asked of each prediction", "%.3f", confidence_);
    status.addf("age of the predictions", "%.2f s", age_s);
    status.add("predictions refused", predictions_.refused());
    status.add("last refusal of predictions", predictions_.refusal());
    diagnose_effort(local_.record(), status);
    status.add("local plans solved", counts.solved);
    status.add("local plans followed", counts.followed);
    status.add("switches of class while swerving", counts.switches);
    status.add("last local plan", local_.message());
    status.add("times no certified motion existed",
               replanning_.replanner().count(Row::kLastResort));
  }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    const bool failed = reason_ == PlanReason::kNoMap || reason_ == PlanReason::kNoPose ||
                        reason_ == PlanReason::kEmergencyStop;
    const auto level = failed                           ? DiagnosticStatus::ERROR
                       : reason_ == PlanReason::kSolved ? DiagnosticStatus::OK
                                                        : DiagnosticStatus::WARN;
    status.summary(level, text_.empty() ? to_text(reason_) : text_);
    status.add("doing", to_text(row_));
    status.add("committed sequence", replanning_.committed_id().sequence);
    status.add("proposals refused", replanning_.refused());
    status.add("last refusal", replanning_.refusal());
    status.add("messages refused", refused_messages_ + map_.refused() + peers_.refused() +
                                       pose_.refused() + predictions_.refused() + zones_.refused());
    for (const auto& [name, value] : MarginBudget::of(model_).listed()) status.add(name, value);
  }

  const RobotIdentity identity_;
  const RobotModel model_;
  const double max_prediction_age_s_;
  const ros::Duration prediction_horizon_;
  LocalReplanning replanning_;
  EmergencyStopListener stop_;
  PoseSource pose_;
  MapSource map_;
  PeerSource peers_;
  ZoneSource zones_;
  PredictionSource predictions_;
  RiskOptions risk_;
  double confidence_ = 0.0;  // that the newest risk asks of each prediction
  LocalOutputs local_;
  ros::Publisher proposals_;
  ros::Publisher leases_;
  ros::Publisher requests_;
  ros::Publisher statuses_;
  ros::Subscriber plans_;
  ros::Subscriber commitments_;
  ros::Subscriber settlements_;
  diagnostic_updater::Updater diagnostics_;
  ros::Time now_;
  int refused_messages_ = 0;
  Row row_ = Row::kKeep;
  PlanReason reason_ = PlanReason::kNoPose;
  std::string text_ = "starting";
  std::set<FallbackKind> fallbacks_;  // of the last local plan
  StepLoop loop_;
};

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  mocha::keep_freed_memory();
  return mocha::run_node<mocha::LocalReplannerNode>(argc, argv, "local_replanner");
}
