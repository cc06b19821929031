#include "benchmarks/broadcaster_node.h"

#include <stdexcept>
#include <utility>
#include <variant>

namespace mocha {
namespace {

constexpr double kTrackerWait_s = 1.0;  // as the node has it

}  // namespace

BroadcasterNode::BroadcasterNode(const std::string& name, const RobotModel& robot,
                                 std::uint32_t epoch, double first_lease_s,
                                 const FleetOptions& options)
    : name_(name),
      robot_(robot),
      protocol_(commitment_options(name, robot, epoch, options)),
      keeping_(robot, first_lease_s, protocol_.options().reach.radio_range_m, protocol_),
      link_(name, std::nullopt) {}

CommittedTrajectory BroadcasterNode::wish_of(std::uint32_t sequence, const Motion& motion,
                                             bool emergency) const {
  CommittedTrajectory wish;
  wish.agent = name_;
  wish.id.sequence = sequence;
  wish.state = emergency ? TrajectoryState::kEmergency : TrajectoryState::kProposed;
  wish.footprint_radius_m = robot_.footprint.circumscribed_radius_m();
  wish.braking = robot_.braking();
  wish.motion = std::make_shared<const Motion>(motion);
  return wish;
}

BroadcasterNode::Output BroadcasterNode::propose(const ProposedMotion& proposal, double now_s) {
  if (!awake_ && !proposal.emergency)
    throw std::invalid_argument("just started, does not know yet what is driven");
  const CommitmentNews news = keeping_.propose(
      proposal.sequence, wish_of(proposal.sequence, proposal.motion, proposal.emergency), now_s);
  awake_ = true;
  Output output;
  add(news, output);
  return output;
}

BroadcasterNode::Output BroadcasterNode::settle(double now_s) {
  Output output;
  if (!awake_) wake_up(now_s, output);
  if (!awake_) return output;
  add(keeping_.tick(now_s), output);
  output.fleet = keeping_.fleet_news(now_s);
  return output;
}

/// As soon as it is known what is driven, or there is no tracker that could tell.
void BroadcasterNode::wake_up(double now_s, Output& output) {
  if (!wake_up_s_) wake_up_s_ = now_s + kTrackerWait_s;
  if (!driven_ && now_s < *wake_up_s_) return;
  if (driven_ && !driven_->motion.empty()) {
    try {
      add(keeping_.resume(wish_of(driven_->id.sequence, driven_->motion, true), now_s), output);
    } catch (const std::invalid_argument&) {  // promises nothing until the replanner does
    }
  }
  awake_ = true;
}

BroadcasterNode::Output BroadcasterNode::hear(const DatagramLink::Bytes& datagram, double now_s) {
  Output output;
  const auto message = link_.unpack(datagram.data(), datagram.size());
  if (!message) return output;
  if (const auto* intent = std::get_if<PassingIntent>(&*message)) {
    output.passing = *intent;
  } else if (const auto* instruction = std::get_if<PassingInstruction>(&*message)) {
    output.passing = *instruction;
  } else if (!awake_) {
    return output;
  } else if (const auto* trajectory = std::get_if<CommittedTrajectory>(&*message)) {
    add(keeping_.receive(*trajectory, now_s), output);
  } else if (const auto* heartbeat = std::get_if<Heartbeat>(&*message)) {
    add(keeping_.receive(*heartbeat, now_s), output);
  }
  return output;
}

BroadcasterNode::Datagrams BroadcasterNode::relay(PassingMessage message) {
  Datagrams sent;
  if (auto* intent = std::get_if<PassingIntent>(&message)) {
    intent->epoch = protocol_.epoch();
    send(*intent, sent);
  } else if (auto* instruction = std::get_if<PassingInstruction>(&message)) {
    instruction->id.epoch = protocol_.epoch();
    send(*instruction, sent);
  }
  return sent;
}

void BroadcasterNode::add(const CommitmentNews& news, Output& output) {
  for (const FleetMessage& message : news.messages) send(message, output.sent);
  for (const Settled& settled : news.settled) output.results.push_back({settled, awake_});
}

void BroadcasterNode::send(const FleetMessage& message, Datagrams& sent) {
  for (DatagramLink::Bytes& datagram : link_.pack(message)) sent.push_back(std::move(datagram));
}

}  // namespace mocha
