#include <diagnostic_updater/diagnostic_updater.h>
#include <mocha_ugv/FleetTrajectories.h>
#include <mocha_ugv/Lease.h>
#include <ros/ros.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "fleet/protocol/commitment_protocol.h"
#include "fleet/storage/epoch_store.h"
#include "ros_bridge/inputs/emergency_stop_controls.h"
#include "ros_bridge/messages/committed_trajectory_conversions.h"
#include "ros_bridge/messages/conversions.h"
#include "ros_bridge/network/fleet_network.h"
#include "ros_bridge/network/passing_relay.h"
#include "ros_bridge/outputs/peer_diagnostics.h"
#include "ros_bridge/outputs/promise_diagnostics.h"
#include "ros_bridge/runtime/memory_file.h"
#include "ros_bridge/runtime/parameters.h"
#include "ros_bridge/runtime/robot_identity.h"
#include "ros_bridge/runtime/run_node.h"
#include "ros_bridge/runtime/step_loop.h"
#include "ros_bridge/runtime/transport.h"
#include "ros_bridge/rviz/markers.h"
#include "stack/commitment_keeping.h"
#include "world/robot_model.h"

namespace mocha {
namespace {

constexpr double kPeriod_s = 0.02;
constexpr double kTrackerWait_s = 1.0;  // for the word of a tracker that may not be there

/// Settles the proposals of this robot with its peers, and publishes the one motion that it
/// executes.
///
/// Numbers: between robots a motion is known by epoch (counts the starts of this node, from a file)
/// and a sequence that this node counts from 1. `committed_trajectory` and `settlement` carry the
/// sequence of the local replanner's proposal instead, together with this node's epoch; it need not
/// begin at any particular number, and is best continued from the latched `committed_trajectory`
/// when the replanner starts anew, so that the tracker sees it grow.
///
/// Restarts: the tracker drives on what a former epoch promised. So this node first of all promises
/// what the latched `driven_trajectory` says, under the same number; its lease stays the
/// replanner's to renew. Until it has heard that, or a second is over without a tracker, this node
/// takes no message of its peers and sends none. An emergency motion of its replanner is binding at
/// once even then.
class TrajectoryBroadcasterNode {
 public:
  TrajectoryBroadcasterNode(ros::NodeHandle& node, const ParameterTable& values)
      : robot_(robot_identity()),
        model_(own_robot_model(values)),
        epoch_file_(memory_file(values.text("epoch_file"), robot_.name, ".epoch")),
        reach_(
            Reach::from(values, model_, neighbour_parameters("local_replanner").number("horizon"))),
        commitment_(
            CommitmentOptions::from(values, model_, reach_, robot_.name, next_epoch(epoch_file_))),
        keeping_(model_, neighbour_parameters("local_replanner").number("lease"),
                 reach_.radio_range_m, commitment_),
        committed_(node.advertise<mocha_ugv::Trajectory>("committed_trajectory", 10, true)),
        fleet_(node.advertise<mocha_ugv::FleetTrajectories>("fleet/trajectories", 10, true)),
        drawings_(node.advertise<visualization_msgs::MarkerArray>("motion_markers", 2, true)),
        leases_out_(node.advertise<mocha_ugv::Lease>("lease", 10)),
        settlements_(node.advertise<mocha_ugv::Settlement>("settlement", 20)),
        proposals_(node.subscribe("proposed_trajectory", 100,
                                  &TrajectoryBroadcasterNode::on_proposal, this, at_once())),
        tracker_(node.subscribe("driven_trajectory", 1, &TrajectoryBroadcasterNode::on_driven, this,
                                at_once())),
        leases_(
            node.subscribe("lease", 100, &TrajectoryBroadcasterNode::on_lease, this, at_once())),
        passing_(
            node, robot_, commitment_.epoch(),
            {[this](const PassingMessage& message) { send(message); },
             [this](const std::string& topic, const std::string& why) { refuse(topic, why); }}),
        network_(node, robot_, {values.text("lcm_url"), values.text("fleet_key")},
                 [this](const FleetMessage& message) { hear(message); }),
        stop_(node, robot_, commitment_.epoch(), beside(epoch_file_, ".stops"),
              {[this](const FleetStops& stops) { network_.send(stops, now_); },
               [this] { draw(drawn_); }}),
        loop_(node, robot_.name, kPeriod_s, [this](ros::Time now) { step(now); }) {
    diagnostics_.setHardwareID(robot_.name);
    diagnostics_.add("promises", this, &TrajectoryBroadcasterNode::diagnose);
    diagnostics_.add("emergency stop", &stop_, &EmergencyStopControls::diagnose);
    diagnostics_.add("fleet network", this, &TrajectoryBroadcasterNode::diagnose_network);
    draw(Motion());
    ROS_INFO("%s: epoch %u", robot_.name.c_str(), commitment_.epoch());
  }

 private:
  void on_proposal(const mocha_ugv::Trajectory& message) {
    if (!advance_clock(ros::Time::now())) return;
    try {
      if (message.agent != robot_.name) {
        throw std::invalid_argument("is of '" + message.agent + "'");
      }
      if (!awake_ && message.state != mocha_ugv::Trajectory::EMERGENCY)
        throw std::invalid_argument("just started, does not know yet what is driven");
      const CommitmentNews news =
          keeping_.propose(message.sequence, trajectory_from_message(message, robot_.map_frame),
                           now_.toSec(), stop_.stopped() ? stop_.message() : "");
      awake_ = true;
      apply(news);
    } catch (const std::invalid_argument& error) {
      refuse("proposed_trajectory", error.what());
      answer_invalid(message.sequence, error.what());
    }
  }

  void on_driven(const mocha_ugv::Trajectory::ConstPtr& message) { driven_ = message; }

  /// As soon as it is known what is driven, or there is no tracker that could tell.
  void wake_up() {
    if (wake_up_at_.isZero()) wake_up_at_ = now_ + ros::Duration(kTrackerWait_s);
    if (driven_ == nullptr && now_ < wake_up_at_) return;
    if (driven_ != nullptr && !driven_->phases.empty()) resume();
    awake_ = true;
  }

  void resume() {
    try {
      apply(keeping_.resume(trajectory_from_message(*driven_, robot_.map_frame), now_.toSec()));
      ROS_INFO("%s: goes on with motion %u, which is driven", robot_.name.c_str(),
               driven_->sequence);
    } catch (const std::invalid_argument& error) {
      refuse("driven_trajectory", error.what());
    }
  }

  void answer_invalid(std::uint32_t sequence, const std::string& why) {
    mocha_ugv::Settlement settlement;
    settlement.header.stamp = now_;
    settlement.header.frame_id = robot_.map_frame;
    settlement.result = mocha_ugv::Settlement::INVALID;
    settlement.epoch = commitment_.epoch();
    settlement.sequence = sequence;
    settlement.message = why;
    settlements_.publish(settlement);
  }

  void refuse(const std::string& topic, const std::string& why) {
    ++refused_;
    refusal_ = why;
    ROS_WARN_THROTTLE(1.0, "Refused a message on %s: %s", topic.c_str(), why.c_str());
  }

  void send(const PassingMessage& message) {
    if (!advance_clock(ros::Time::now())) return;
    std::visit([this](const auto& each) { network_.send(each, now_); }, message);
  }

  void on_lease(const mocha_ugv::Lease& message) {
    keeping_.renew({{message.epoch, message.sequence}, message.valid_until.toSec()});
  }

  void hear(const FleetMessage& message) {
    if (!advance_clock(ros::Time::now())) return;
    if (const auto* intent = std::get_if<PassingIntent>(&message)) {
      passing_.publish(*intent, now_);
    } else if (const auto* instruction = std::get_if<PassingInstruction>(&message)) {
      passing_.publish(*instruction, now_);
    } else if (const auto* stops = std::get_if<FleetStops>(&message)) {
      stop_.hear(*stops, now_);
    } else if (!awake_) {
      return;
    } else if (const auto* trajectory = std::get_if<CommittedTrajectory>(&message)) {
      apply(keeping_.receive(*trajectory, now_.toSec()));
    } else {
      apply(keeping_.receive(std::get<Heartbeat>(message), now_.toSec()));
    }
  }

  /// False while there is no time yet. Within a step, time does not run backward.
  bool advance_clock(ros::Time now) {
    if (now + ros::Duration(1.0) < now_) {
      throw std::runtime_error("the clock was set back; promises in the old time are void");
    }
    now_ = std::max(now_, now);
    return !now_.isZero();
  }

  void step(ros::Time now) {
    if (!advance_clock(now)) return;
    stop_.step(now_);
    if (!awake_) wake_up();
    if (awake_) {
      apply(keeping_.tick(now_.toSec()));
      go_on_after_known_epoch();
      publish_fleet();
    }
    diagnostics_.update();
  }

  /// Where the file that counts the starts was lost, the peers take this robot for its own past.
  void go_on_after_known_epoch() {
    const std::uint32_t known = commitment_.peers().known_epoch();
    if (known <= commitment_.epoch()) return;
    raise_epoch(epoch_file_, known);
    throw std::runtime_error("peers know epoch " + std::to_string(known) + " of this robot, but " +
                             epoch_file_ + " said " + std::to_string(commitment_.epoch()) +
                             "; it is set right, and this node starts anew");
  }

  void apply(const CommitmentNews& news) {
    if (news.lease_ended) {
      ROS_WARN("%s: the lease of motion %u ended: brakes", robot_.name.c_str(), *news.lease_ended);
    }
    if (!news.unsaid.empty()) {
      ROS_ERROR("%s: the stop cannot be said to the others: %s", robot_.name.c_str(),
                news.unsaid.c_str());
    }
    for (const FleetMessage& message : news.messages) network_.send(message, now_);
    for (const Settled& settled : news.settled) report(settled);
  }

  void report(const Settled& settled) {
    using Kind = CommitmentEvent::Kind;
    const mocha_ugv::Settlement settlement = settlement_of(settled, robot_.map_frame, now_);
    if (settled.in_force) {
      commit(*settled.in_force);
    } else if (settled.event.kind == Kind::kBreached) {
      ROS_WARN("%s: %s", robot_.name.c_str(), settlement.message.c_str());
      publish_fleet();  // what the replanner has to look at
    } else {
      ROS_INFO_THROTTLE(1.0, "%s: proposal %u: %s", robot_.name.c_str(), settlement.sequence,
                        settlement.message.c_str());
    }
    settlements_.publish(settlement);
  }

  void commit(const MotionInForce& in_force) {
    mocha_ugv::Trajectory committed = to_message(in_force.trajectory, robot_.map_frame, now_);
    committed.sequence = in_force.lease.id.sequence;
    committed_.publish(committed);
    draw(*in_force.trajectory.motion);
    if (!awake_) return;  // whether it is to be driven on is for the replanner to say
    mocha_ugv::Lease lease;
    lease.header.stamp = now_;
    lease.epoch = in_force.lease.id.epoch;
    lease.sequence = in_force.lease.id.sequence;
    lease.valid_until = ros::Time(in_force.lease.end_s);
    leases_out_.publish(lease);
  }

  /// The robot, and what it drives.
  void draw(const Motion& motion) {
    drawn_ = motion;
    Drawing drawing(robot_.map_frame, now_);
    drawing.add_motion("committed", motion, model_.limits.max_speed);
    drawing.add_robot(robot_.name + (stop_.stopped() ? ": EMERGENCY STOP" : ""), robot_.base_frame,
                      model_.footprint);
    drawings_.publish(drawing.markers());
  }

  void publish_fleet() {
    const auto news = keeping_.fleet_news(now_.toSec());
    if (!news) return;
    mocha_ugv::FleetTrajectories fleet;
    fleet.header.stamp = now_;
    fleet.header.frame_id = robot_.map_frame;
    for (const CommittedTrajectory& promise : *news) {
      fleet.trajectories.push_back(to_message(promise, robot_.map_frame, now_));
      fleet.mistimed.push_back(promise.mistimed_s);
    }
    fleet_.publish(fleet);
  }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
    diagnose_promises(commitment_, keeping_, now_.toSec(), status);
    if (!awake_) status.summary(diagnostic_msgs::DiagnosticStatus::OK, "waits for its tracker");
    status.add("refused proposals", refused_);
    if (refused_ > 0) status.add("last refused proposal", refusal_);
  }

  void diagnose_network(diagnostic_updater::DiagnosticStatusWrapper& status) {
    status.summary(diagnostic_msgs::DiagnosticStatus::OK, "hears its fleet");
    network_.diagnose(status);
    diagnose_peers(
        commitment_.peers(), now_.toSec(), commitment_.options().delta_dc_s,
        [this](const std::string& peer) { return network_.loss(peer); }, status);
  }

  const RobotIdentity robot_;
  const RobotModel model_;
  const std::string epoch_file_;
  const Reach reach_;
  CommitmentProtocol commitment_;
  CommitmentKeeping keeping_;
  ros::Time now_;
  ros::Time wake_up_at_;
  bool awake_ = false;
  mocha_ugv::Trajectory::ConstPtr driven_;
  Motion drawn_;
  int refused_ = 0;
  std::string refusal_;
  diagnostic_updater::Updater diagnostics_;
  ros::Publisher committed_;
  ros::Publisher fleet_;
  ros::Publisher drawings_;
  ros::Publisher leases_out_;
  ros::Publisher settlements_;
  ros::Subscriber proposals_;
  ros::Subscriber tracker_;
  ros::Subscriber leases_;
  PassingRelay passing_;
  FleetNetwork network_;
  EmergencyStopControls stop_;
  StepLoop loop_;
};

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  return mocha::run_node<mocha::TrajectoryBroadcasterNode>(argc, argv, "trajectory_broadcaster");
}
