#include <diagnostic_updater/diagnostic_updater.h>
#include <mocha_ugv/FleetTrajectories.h>
#include <mocha_ugv/Lease.h>
#include <ros/ros.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "control/lease.h"
#include "fleet/protocol/commitment_protocol.h"
#include "fleet/storage/epoch_store.h"
#include "fleet/wire/wire_format.h"
#include "ros_bridge/inputs/emergency_stop_controls.h"
#include "ros_bridge/messages/committed_trajectory_conversions.h"
#include "ros_bridge/messages/conversions.h"
#include "ros_bridge/messages/yield_request_conversions.h"
#include "ros_bridge/network/fleet_network.h"
#include "ros_bridge/outputs/peer_diagnostics.h"
#include "ros_bridge/runtime/parameters.h"
#include "ros_bridge/runtime/robot_identity.h"
#include "ros_bridge/runtime/run_node.h"
#include "ros_bridge/runtime/step_loop.h"
#include "ros_bridge/runtime/transport.h"
#include "ros_bridge/rviz/markers.h"
#include "world/robot_model.h"

namespace mocha {
namespace {

constexpr double kPeriod_s = 0.02;
constexpr double kFleetPeriod_s = 0.5;

std::string epoch_file(const std::string& parameter, const std::string& robot) {
  if (!parameter.empty()) return parameter;
  const char* ros_home = std::getenv("ROS_HOME");
  const char* home = std::getenv("HOME");
  if (ros_home == nullptr && home == nullptr) {
    throw std::runtime_error("epoch_file is empty, and there is neither ROS_HOME nor HOME");
  }
  const std::string folder = ros_home != nullptr ? ros_home : std::string(home) + "/.ros";
  return folder + "/mocha_ugv/" + robot + ".epoch";
}

/// Beside the file that counts the starts.
std::string stop_file(const std::string& epochs) {
  return std::filesystem::path(epochs).replace_extension(".stops").string();
}

const char* text_of(CommitmentProtocol::State state) {
  switch (state) {
    case CommitmentProtocol::State::kListening:
      return "listening for who is there";
    case CommitmentProtocol::State::kIdle:
      return "nothing promised";
    case CommitmentProtocol::State::kProposing:
      return "settling the first motion";
    case CommitmentProtocol::State::kBound:
      return "promised";
    case CommitmentProtocol::State::kRevising:
      return "promised, settling the next motion";
  }
  return "unknown";
}

/// Settles the proposals of this robot with its peers, and publishes the one motion that it
/// executes.
///
/// Numbers: between robots a motion is known by epoch (counts the starts of this node, from a file)
/// and a sequence that this node counts from 1. `committed_trajectory` and `settlement` carry the
/// sequence of the local replanner's proposal instead, together with this node's epoch; it need not
/// begin at any particular number, and is best continued from the latched `committed_trajectory`
/// when the replanner starts anew, so that the tracker sees it grow. After a restart of this node
/// nothing is binding until the next proposal; the peers keep the former promise until then, and so
/// does the tracker under its lease.
class TrajectoryBroadcasterNode {
 public:
  TrajectoryBroadcasterNode(ros::NodeHandle& node, const ParameterTable& values)
      : robot_(robot_identity()),
        model_(load_robot_model(config_path(""), values.text("robot_model"))),
        initial_lease_(values.number("initial_lease")),
        epoch_file_(epoch_file(values.text("epoch_file"), robot_.name)),
        commitment_(CommitmentOptions::from(values, model_, robot_.name, next_epoch(epoch_file_))),
        committed_(node.advertise<mocha_ugv::Trajectory>("committed_trajectory", 10, true)),
        fleet_(node.advertise<mocha_ugv::FleetTrajectories>("fleet/trajectories", 10, true)),
        drawings_(node.advertise<visualization_msgs::MarkerArray>("motion_markers", 2, true)),
        leases_out_(node.advertise<mocha_ugv::Lease>("lease", 10)),
        settlements_(node.advertise<mocha_ugv::Settlement>("settlement", 20)),
        requests_out_(node.advertise<mocha_ugv::YieldRequest>("fleet/yield_requests", 100)),
        proposals_(node.subscribe("proposed_trajectory", 100,
                                  &TrajectoryBroadcasterNode::on_proposal, this, at_once())),
        leases_(
            node.subscribe("lease", 100, &TrajectoryBroadcasterNode::on_lease, this, at_once())),
        requests_(node.subscribe("yield_request", 10, &TrajectoryBroadcasterNode::on_yield_request,
                                 this, at_once())),
        network_(node, robot_, {values.text("lcm_url"), values.text("fleet_key")},
                 [this](const FleetMessage& message) { hear(message); }),
        stop_(node, robot_, commitment_.options().epoch, stop_file(epoch_file_),
              {[this](const FleetStops& stops) { network_.send(stops, now_); },
               [this] { draw(drawn_); }}),
        loop_(node, robot_.name, kPeriod_s, [this](ros::Time now) { step(now); }) {
    diagnostics_.setHardwareID(robot_.name);
    diagnostics_.add("promises", this, &TrajectoryBroadcasterNode::diagnose);
    diagnostics_.add("emergency stop", &stop_, &EmergencyStopControls::diagnose);
    diagnostics_.add("fleet network", this, &TrajectoryBroadcasterNode::diagnose_network);
    draw(Motion());
    ROS_INFO("%s: epoch %u", robot_.name.c_str(), commitment_.options().epoch);
  }

 private:
  void on_proposal(const mocha_ugv::Trajectory& message) {
    if (!advance_clock(ros::Time::now())) return;
    try {
      if (message.agent != robot_.name) {
        throw std::invalid_argument("is of '" + message.agent + "'");
      }
      // As everybody else will hear it.
      const CommittedTrajectory wish =
          quantised(trajectory_from_message(message, robot_.map_frame));
      if (message.sequence <= stop_sequence_) {
        throw std::invalid_argument("was made before the robot braked, as its lease had ended");
      }
      newest_sequence_ = std::max(newest_sequence_, message.sequence);
      const Proposal proposal{message.sequence, wish.footprint_radius_m, wish.motion};
      if (wish.state == TrajectoryState::kProposed && stop_.stopped()) {
        throw std::invalid_argument(stop_.message());
      }
      if (wish.state == TrajectoryState::kProposed) {
        apply(commitment_.propose(proposal, now_.toSec()));
      } else if (wish.state == TrajectoryState::kEmergency) {
        apply(commitment_.brake(proposal, now_.toSec()));
      } else {
        throw std::invalid_argument("is neither PROPOSED nor EMERGENCY");
      }
    } catch (const std::invalid_argument& error) {
      ++refused_;
      refusal_ = error.what();
      ROS_WARN_THROTTLE(1.0, "Refused a message on proposed_trajectory: %s", error.what());
      mocha_ugv::Settlement settlement;
      settlement.header.stamp = now_;
      settlement.header.frame_id = robot_.map_frame;
      settlement.result = mocha_ugv::Settlement::INVALID;
      settlement.epoch = commitment_.options().epoch;
      settlement.sequence = message.sequence;
      settlement.message = error.what();
      settlements_.publish(settlement);
    }
  }

  /// For all team-mates, who make nothing of one in another name.
  void on_yield_request(const mocha_ugv::YieldRequest& message) {
    if (!advance_clock(ros::Time::now())) return;
    try {
      YieldRequest request = yield_request_from_message(message, robot_.map_frame);
      if (request.agent != robot_.name) {
        throw std::invalid_argument("is of '" + request.agent + "'");
      }
      request.epoch = commitment_.options().epoch;
      network_.send(request, now_);
    } catch (const std::invalid_argument& error) {
      ++refused_;
      refusal_ = error.what();
      ROS_WARN_THROTTLE(1.0, "Refused a message on yield_request: %s", error.what());
    }
  }

  void on_lease(const mocha_ugv::Lease& message) {
    lease_.renew({message.epoch, message.sequence}, message.valid_until.toSec());
  }

  void hear(const FleetMessage& message) {
    if (!advance_clock(ros::Time::now())) return;
    if (const auto* request = std::get_if<YieldRequest>(&message)) {
      requests_out_.publish(to_message(*request, robot_.map_frame, now_));
    } else if (const auto* stops = std::get_if<FleetStops>(&message)) {
      stop_.hear(*stops, now_);
    } else if (const auto* trajectory = std::get_if<CommittedTrajectory>(&message)) {
      apply(commitment_.receive(*trajectory, now_.toSec()));
    } else {
      apply(commitment_.receive(std::get<Heartbeat>(message), now_.toSec()));
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
    stop_where_the_lease_ended();
    apply(commitment_.tick(now_.toSec()));
    go_on_after_known_epoch();
    publish_fleet();
    diagnostics_.update();
  }

  /// Where the file that counts the starts was lost, the peers take this robot for its own past.
  void go_on_after_known_epoch() {
    const std::uint32_t known = commitment_.peers().known_epoch();
    if (known <= commitment_.options().epoch) return;
    raise_epoch(epoch_file_, known);
    throw std::runtime_error("peers know epoch " + std::to_string(known) + " of this robot, but " +
                             epoch_file_ + " said " + std::to_string(commitment_.options().epoch) +
                             "; it is set right, and this node starts anew");
  }

  void apply(const CommitmentActions& actions) {
    for (const CommittedTrajectory& trajectory : actions.trajectories)
      network_.send(trajectory, now_);
    if (actions.heartbeat) network_.send(*actions.heartbeat, now_);
    for (const CommitmentEvent& event : actions.events) report(event);
  }

  void report(const CommitmentEvent& event) {
    using Kind = CommitmentEvent::Kind;
    mocha_ugv::Settlement settlement = settlement_of(event, robot_.map_frame, now_);
    if (event.refusal != Refusal::kNone) ++refusals_[name_of(event.refusal)];
    if (event.kind == Kind::kBreached) {
      ++breaches_;
      ROS_WARN("%s: %s", robot_.name.c_str(), settlement.message.c_str());
      settlement.sequence = committed_sequence_;
      publish_fleet();  // what the replanner has to look at
    } else if (event.kind == Kind::kSettled) {
      commit(event);
    } else {
      ROS_INFO_THROTTLE(1.0, "%s: proposal %u: %s", robot_.name.c_str(), settlement.sequence,
                        settlement.message.c_str());
    }
    settlements_.publish(settlement);
  }

  /// What is executed begins now: until the new motion starts, the one before it is in force.
  void commit(const CommitmentEvent& event) {
    CommittedTrajectory in_force = event.trajectory;
    in_force.motion = commitment_.binding().composed(now_.toSec());
    mocha_ugv::Trajectory committed = to_message(in_force, robot_.map_frame, now_);
    committed.sequence = event.proposal.tag;
    committed_sequence_ = event.proposal.tag;
    committed_.publish(committed);
    grant_first_lease(*in_force.motion);
    draw(*in_force.motion);
  }

  void grant_first_lease(const Motion& motion) {
    mocha_ugv::Lease lease;
    lease.header.stamp = now_;
    lease.epoch = commitment_.options().epoch;
    lease.sequence = committed_sequence_;
    lease.valid_until = now_ + initial_lease_;
    leases_out_.publish(lease);
    lease_.commit({lease.epoch, lease.sequence}, motion, lease.valid_until.toSec());
  }

  /// The tracker brakes now: that is what is promised from now on. What the replanner proposed
  /// before it hears so was made for another motion.
  void stop_where_the_lease_ended() {
    const auto stop = lease_.expire(now_.toSec(), model_.braking());
    if (!stop) return;
    ++lease_stops_;
    stop_sequence_ = ++newest_sequence_;
    ROS_WARN("%s: the lease of motion %u ended: brakes", robot_.name.c_str(), committed_sequence_);
    try {
      const auto motion = std::make_shared<const Motion>(quantised(*stop));
      const double radius_m = model_.footprint.circumscribed_radius_m();
      apply(commitment_.brake({stop_sequence_, radius_m, motion}, now_.toSec()));
    } catch (const std::invalid_argument& error) {
      ROS_ERROR("%s: the stop cannot be said to the others: %s", robot_.name.c_str(), error.what());
    }
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
    std::vector<TrajectoryId> news;
    for (const auto& [name, peer] : commitment_.peers().peers()) {
      for (const Reservation& reservation : peer.binding.reservations())
        news.push_back(reservation.trajectory.id);
    }
    if (news == published_ && now_ < next_fleet_) return;
    published_ = std::move(news);
    next_fleet_ = now_ + ros::Duration(kFleetPeriod_s);
    mocha_ugv::FleetTrajectories fleet;
    for (const auto& [name, peer] : commitment_.peers().peers()) {
      for (const Reservation& part : peer.binding.parts(now_.toSec()))
        fleet.trajectories.push_back(to_message(part.trajectory, robot_.map_frame, now_));
    }
    fleet.header.stamp = now_;
    fleet.header.frame_id = robot_.map_frame;
    fleet_.publish(fleet);
  }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    status.summary(DiagnosticStatus::OK, text_of(commitment_.state()));
    if (breaches_ > 0) {
      status.mergeSummary(DiagnosticStatus::WARN, "peers broke promises that met ours");
    }
    status.add("epoch", commitment_.options().epoch);
    if (!commitment_.binding().empty()) {
      status.add("binding sequence", commitment_.binding().newest().id.sequence);
    }
    status.addf("lease remaining (s)", "%.2f", std::max(0.0, lease_.end_s() - now_.toSec()));
    status.add("stops as a lease ended", lease_stops_);
    for (const auto& [refusal, count] : refusals_)
      status.add("proposals refused: " + refusal, count);
    status.add("breaches", breaches_);
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
  const ros::Duration initial_lease_;
  const std::string epoch_file_;
  CommitmentProtocol commitment_;
  ros::Time now_;
  ros::Time next_fleet_;
  std::vector<TrajectoryId> published_;
  Motion drawn_;
  std::uint32_t committed_sequence_ = 0;
  std::uint32_t stop_sequence_ = 0;    // of the newest stop without a lease
  std::uint32_t newest_sequence_ = 0;  // heard of, or given to a stop
  int lease_stops_ = 0;
  LeaseWatch lease_;
  std::map<std::string, int> refusals_;
  int breaches_ = 0;
  int refused_ = 0;
  std::string refusal_;
  diagnostic_updater::Updater diagnostics_;
  ros::Publisher committed_;
  ros::Publisher fleet_;
  ros::Publisher drawings_;
  ros::Publisher leases_out_;
  ros::Publisher settlements_;
  ros::Publisher requests_out_;
  ros::Subscriber proposals_;
  ros::Subscriber leases_;
  ros::Subscriber requests_;
  FleetNetwork network_;
  EmergencyStopControls stop_;
  StepLoop loop_;
};

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  return mocha::run_node<mocha::TrajectoryBroadcasterNode>(argc, argv, "trajectory_broadcaster");
}
