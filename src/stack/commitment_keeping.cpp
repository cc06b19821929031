#include "stack/commitment_keeping.h"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

#include "trajectory/splice.h"

namespace mocha {

CommitmentKeeping::CommitmentKeeping(const RobotModel& robot, double first_lease_s,
                                     double radio_range_m, SettlingProtocol& protocol)
    : robot_(robot),
      first_lease_s_(first_lease_s),
      radio_range_m_(radio_range_m),
      protocol_(protocol) {}

CommitmentNews CommitmentKeeping::propose(std::uint32_t sequence, const CommittedTrajectory& wish,
                                          double now_s, const std::string& stop) {
  const CommittedTrajectory heard = quantised(wish);
  if (sequence <= stop_sequence_)
    throw std::invalid_argument("was made before the robot braked, as its lease had ended");
  newest_sequence_ = std::max(newest_sequence_, sequence);
  const bool emergency = heard.state == TrajectoryState::kEmergency;
  if (!emergency && heard.state != TrajectoryState::kProposed)
    throw std::invalid_argument("is neither PROPOSED nor EMERGENCY");
  if (!emergency && !stop.empty()) throw std::invalid_argument(stop);
  const Proposal proposal{sequence, heard.footprint_radius_m, heard.braking, heard.motion};
  CommitmentNews news;
  add(emergency ? protocol_.brake(proposal, now_s) : protocol_.propose(proposal, now_s), now_s,
      news);
  return news;
}

CommitmentNews CommitmentKeeping::resume(const CommittedTrajectory& driven, double now_s) {
  CommittedTrajectory rest = driven;
  rest.state = TrajectoryState::kEmergency;  // binds at once
  rest.motion = std::make_shared<const Motion>(rest_of(*driven.motion, now_s));
  return propose(driven.id.sequence, rest, now_s);
}

CommitmentNews CommitmentKeeping::receive(const CommittedTrajectory& promise, double now_s) {
  CommitmentNews news;
  add(protocol_.receive(promise, now_s), now_s, news);
  return news;
}

CommitmentNews CommitmentKeeping::receive(const Heartbeat& heartbeat, double now_s) {
  CommitmentNews news;
  add(protocol_.receive(heartbeat, now_s), now_s, news);
  return news;
}

CommitmentNews CommitmentKeeping::tick(double now_s) {
  CommitmentNews news;
  stop_where_the_lease_ended(now_s, news);
  add(protocol_.tick(now_s), now_s, news);
  return news;
}

/// The tracker brakes now: that is what is promised from now on. Proposals that were made before
/// were made for another motion.
void CommitmentKeeping::stop_where_the_lease_ended(double now_s, CommitmentNews& news) {
  const auto stop = lease_.expire(now_s, robot_.braking());
  if (!stop) return;
  ++counts_.lease_stops;
  news.lease_ended = committed_sequence_;
  stop_sequence_ = ++newest_sequence_;
  try {
    const auto motion = std::make_shared<const Motion>(quantised(*stop));
    const double radius_m = robot_.footprint.circumscribed_radius_m();
    add(protocol_.brake({stop_sequence_, radius_m, robot_.braking(), motion}, now_s), now_s, news);
  } catch (const std::invalid_argument& error) {
    news.unsaid = error.what();
  }
}

void CommitmentKeeping::add(const CommitmentActions& actions, double now_s, CommitmentNews& news) {
  for (const CommittedTrajectory& trajectory : actions.trajectories)
    news.messages.emplace_back(trajectory);
  if (actions.heartbeat) news.messages.emplace_back(*actions.heartbeat);
  for (const CommitmentEvent& event : actions.events) news.settled.push_back(settled(event, now_s));
}

Settled CommitmentKeeping::settled(const CommitmentEvent& event, double now_s) {
  using Kind = CommitmentEvent::Kind;
  if (event.refusal != Refusal::kNone) ++counts_.refusals[name_of(event.refusal)];
  if (event.kind == Kind::kBreached) {
    ++counts_.breaches;
    return {event, committed_sequence_, std::nullopt};
  }
  if (event.kind != Kind::kSettled) return {event, event.proposal.tag, std::nullopt};
  return {event, event.proposal.tag, commit(event, now_s)};
}

MotionInForce CommitmentKeeping::commit(const CommitmentEvent& event, double now_s) {
  committed_sequence_ = event.proposal.tag;
  MotionInForce in_force{event.trajectory,
                         {{protocol_.epoch(), committed_sequence_}, now_s + first_lease_s_}};
  in_force.trajectory.motion = protocol_.binding().composed(now_s);
  lease_.commit(in_force.lease.id, *in_force.trajectory.motion, in_force.lease.end_s);
  return in_force;
}

bool CommitmentKeeping::matters(const Peer& peer, double now_s) const {
  const ReservationChain& own = protocol_.binding();
  if (peer.binding.empty() || own.empty()) return true;
  return (peer.binding.position(now_s) - own.position(now_s)).norm() <= radio_range_m_;
}

std::optional<std::vector<CommittedTrajectory>> CommitmentKeeping::fleet_news(double now_s) {
  std::vector<const Peer*> peers;
  std::vector<std::pair<TrajectoryId, double>> known;
  for (const auto& [name, peer] : protocol_.peers().peers()) {
    if (!matters(peer, now_s)) continue;
    peers.push_back(&peer);
    for (const Reservation& reservation : peer.binding.reservations())
      known.emplace_back(reservation.trajectory.id, reservation.trajectory.motion->start_time());
  }
  if (known == told_ && now_s < tell_again_s_) return std::nullopt;
  told_ = std::move(known);
  tell_again_s_ = now_s + kFleetPeriod_s;
  std::vector<CommittedTrajectory> promises;
  for (const Peer* peer : peers) {
    for (const Reservation& part : peer->binding.parts(now_s)) {
      promises.push_back(part.trajectory);
      const double end_s = part.trajectory.motion->end_time();
      const double mistimed_s = protocol_.peers().mistimed_s(*peer, std::max(now_s, end_s));
      if (end_s + mistimed_s > now_s) promises.back().mistimed_s = mistimed_s;  // it moves
    }
  }
  return promises;
}

}  // namespace mocha
