#include <diagnostic_updater/diagnostic_updater.h>
#include <mocha_ugv/Lease.h>
#include <mocha_ugv/PlannerStatus.h>
#include <mocha_ugv/ReplannerStatus.h>
#include <mocha_ugv/Settlement.h>
#include <mocha_ugv/Trajectory.h>
#include <ros/ros.h>

#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>

#include "planning/replanner/local_replanner.h"
#include "ros_bridge/inputs/emergency_stop_listener.h"
#include "ros_bridge/inputs/map_source.h"
#include "ros_bridge/inputs/peer_source.h"
#include "ros_bridge/inputs/pose_source.h"
#include "ros_bridge/inputs/prediction_source.h"
#include "ros_bridge/messages/conversions.h"
#include "ros_bridge/messages/status_conversions.h"
#include "ros_bridge/outputs/local_outputs.h"
#include "ros_bridge/runtime/parameters.h"
#include "ros_bridge/runtime/robot_identity.h"
#include "ros_bridge/runtime/run_node.h"
#include "ros_bridge/runtime/step_loop.h"
#include "ros_bridge/runtime/transport.h"
#include "topology/static_map/grid_static_map.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

constexpr double kMapBorder_m = 2.0;

std::string seconds(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f s", value);
  return text;
}

/// Promises what the global planner planned and swerves around what moves: plans and predictions
/// in, proposals and leases out.
class LocalReplannerNode {
 public:
  LocalReplannerNode(ros::NodeHandle& node, const ParameterTable& values)
      : identity_(robot_identity()),
        model_(load_robot_model(config_path(""), values.text("robot_model"))),
        lease_(values.number("lease")),
        max_map_age_s_(values.number("max_map_age")),
        max_fleet_age_s_(values.number("max_fleet_age")),
        max_prediction_age_s_(values.number("max_prediction_age")),
        prediction_horizon_(values.number("prediction_horizon")),
        replanner_(model_, LocalReplannerOptions::from(values, model_), LocalOptions::from(values)),
        stop_(node),
        pose_(node, identity_, values.number("max_pose_age"), values.number("max_transform_age")),
        map_(node, identity_.map_frame),
        peers_(node, identity_.name, identity_.map_frame),
        predictions_(node, identity_.map_frame,
                     {values.number("confidence"), values.number("growth_horizon")}),
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
      replanner_.set_plan(message.phases.empty() ? Motion() : from_message(message));
    } catch (const std::exception& error) {
      refuse("global_trajectory", error.what());
    }
  }

  void on_committed(const mocha_ugv::Trajectory& message) {
    try {
      replanner_.set_committed(message.sequence, from_message(message));
      epoch_ = message.epoch;
      committed_sequence_ = message.sequence;
    } catch (const std::exception& error) {
      refuse("committed_trajectory", error.what());
    }
  }

  void on_settlement(const mocha_ugv::Settlement& settlement) {
    using mocha_ugv::Settlement;
    if (settlement.result == Settlement::SETTLED) return;
    if (settlement.result == Settlement::BREACHED) {
      step(ros::Time::now());
      return;
    }
    replanner_.on_refusal(settlement.sequence);
    last_refusal_ = settlement.message;
    ++refused_proposals_;
  }

  void refuse(const std::string& topic, const std::string& why) {
    ++refused_messages_;
    ROS_WARN_THROTTLE(1.0, "Refused a message on %s: %s", topic.c_str(), why.c_str());
  }

  void step(ros::Time now) {
    now_ = now;
    diagnostics_.update();
    const PoseReading reading = pose_.read(now);
    if (stop_.stopped()) {
      halt(now, reading);
      return;
    }
    const auto [reason, missing] = what_is_missing(now, reading);
    if (reason != PlanReason::kSolved) {
      local_.clear(now);
      const auto output = replanner_.stop_blind(now.toSec());
      if (output.proposal) propose(now, *output.proposal);
      report(now, output.row, reason, {}, missing);
      return;
    }
    const LocalScene scene = this->scene(now, reading.state->pose.position);
    const auto output = replanner_.step(now.toSec(), *reading.state, scene);
    local_.show(output, replanner_.plan(), scene.confident, now);
    if (output.row == Row::kLastResort)
      ROS_ERROR_THROTTLE(1.0, "%s: %s", identity_.name.c_str(), output.message.c_str());
    if (output.proposal) propose(now, *output.proposal);
    if (output.renew_lease) renew(now);
    report(now, output.row, output.reason, output.violation, output.message);
    if (output.request_plan) {
      requests_.publish(
          to_message(output.reason, output.violation, output.message, identity_.map_frame, now));
    }
  }

  LocalScene scene(ros::Time now, const Vector2& here) {
    LocalScene scene =
        local_scene(std::make_shared<GridStaticMap>(
                        map_.field(DistanceField::Solid::kOccupied, {here}, kMapBorder_m)),
                    map_.field(DistanceField::Solid::kOccupiedOrUnknown, {here}, kMapBorder_m));
    scene.peers = peers_.obstacles();
    scene.confident = predictions_.obstacles();
    scene.likely = predictions_.expected();
    scene.predicted_until_s = (now + prediction_horizon_).toSec();
    return scene;
  }

  /// Needs no map and no word of the others: what the robot does is promised, whatever it meets.
  void halt(ros::Time now, const PoseReading& reading) {
    local_.clear(now);
    if (reading.state) {
      const auto output = replanner_.halt(now.toSec(), *reading.state);
      if (output.proposal) propose(now, *output.proposal);
    }
    report(now, Row::kEmergencyStop, PlanReason::kEmergencyStop, {},
           reading.state ? stop_.reason() : stop_.reason() + "; " + reading.missing);
  }

  /// What nothing can be proved without, as reason and text; kSolved where all is there.
  std::pair<PlanReason, std::string> what_is_missing(ros::Time now,
                                                     const PoseReading& reading) const {
    if (!reading.state) return {PlanReason::kNoPose, reading.missing};
    if (!map_.available()) {
      return {PlanReason::kNoMap, "map: none on " + ros::names::resolve("map") + " yet"};
    }
    if (map_.age_s(now) > max_map_age_s_) {
      return {PlanReason::kNoMap, "map: the newest on " + ros::names::resolve("map") + " is " +
                                      seconds(map_.age_s(now)) + " old"};
    }
    if (peers_.age_s(now) > max_fleet_age_s_) {
      return {PlanReason::kBraking, "fleet: no word from trajectory_broadcaster on " +
                                        ros::names::resolve("fleet/trajectories") +
                                        " for more than " + seconds(max_fleet_age_s_)};
    }
    if (predictions_.age_s(now) > max_prediction_age_s_) {
      return {PlanReason::kBraking, "people: no usable word from perception on " +
                                        ros::names::resolve("predicted_obstacles") +
                                        " for more than " + seconds(max_prediction_age_s_)};
    }
    return {PlanReason::kSolved, ""};
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
    to_message(proposal.motion, message);
    proposals_.publish(message);
  }

  void renew(ros::Time now) {
    mocha_ugv::Lease lease;
    lease.header.stamp = now;
    lease.epoch = epoch_;
    lease.sequence = committed_sequence_;
    lease.valid_until = now + lease_;
    leases_.publish(lease);
  }

  void report(ros::Time now, Row row, PlanReason reason, const Violation& violation,
              const std::string& text) {
    const bool news = row != row_ || reason != reason_ || text != text_;
    row_ = row;
    reason_ = reason;
    text_ = text;
    if (!news) return;
    statuses_.publish(
        to_message(row, to_message(reason, violation, text, identity_.map_frame, now)));
    if (!text.empty())
      ROS_INFO_THROTTLE(1.0, "%s: %s: %s", identity_.name.c_str(), to_text(reason), text.c_str());
  }

  void diagnose_detours(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    const double age_s = predictions_.age_s(now_);
    const auto things = predictions_.obstacles().size();
    const bool known = age_s <= max_prediction_age_s_;
    status.summary(known ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
                   known ? "things that move: " + std::to_string(things)
                         : "no usable word on predicted_obstacles");
    const LocalOutputs::Counts& counts = local_.counts();
    status.add("things predicted", things);
    status.add("age of the predictions", seconds(age_s));
    status.add("predictions refused", predictions_.refused());
    status.add("last refusal of predictions", predictions_.refusal());
    status.add("local plans made", counts.made);
    status.add("local plans solved", counts.solved);
    status.add("local plans followed", counts.followed);
    status.add("switches of class while swerving", counts.switches);
    status.add("last local plan", local_.message());
    status.add("times no certified motion existed", replanner_.count(Row::kLastResort));
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
    status.add("committed sequence", committed_sequence_);
    status.add("proposals refused", refused_proposals_);
    status.add("last refusal", last_refusal_);
    status.add("messages refused", refused_messages_ + map_.refused() + peers_.refused() +
                                       pose_.refused() + predictions_.refused());
    for (const auto& [name, value] : MarginBudget::of(model_).listed()) status.add(name, value);
  }

  const RobotIdentity identity_;
  const RobotModel model_;
  const ros::Duration lease_;
  const double max_map_age_s_;
  const double max_fleet_age_s_;
  const double max_prediction_age_s_;
  const ros::Duration prediction_horizon_;
  LocalReplanner replanner_;
  EmergencyStopListener stop_;
  PoseSource pose_;
  MapSource map_;
  PeerSource peers_;
  PredictionSource predictions_;
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
  std::uint32_t epoch_ = 0;
  std::uint32_t committed_sequence_ = 0;
  int refused_proposals_ = 0;
  int refused_messages_ = 0;
  std::string last_refusal_;
  Row row_ = Row::kKeep;
  PlanReason reason_ = PlanReason::kNoPose;
  std::string text_ = "starting";
  StepLoop loop_;
};

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  return mocha::run_node<mocha::LocalReplannerNode>(argc, argv, "local_replanner");
}
