#include "fleet/protocol/commitment_protocol.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace mocha {
namespace {

constexpr double kContinuity_m = 0.05;

/// A peer that does not know quite so well where this robot is may wait for its word already.
constexpr double kSpare_s = 0.5;

CommitmentEvent event_of(CommitmentEvent::Kind kind, const CommittedTrajectory& trajectory,
                         const Proposal& proposal) {
  CommitmentEvent event;
  event.kind = kind;
  event.trajectory = trajectory;
  event.proposal = proposal;
  return event;
}

}  // namespace

CommitmentProtocol::CommitmentProtocol(CommitmentOptions options)
    : options_(std::move(options)),
      peers_(options_.agent, options_.epoch, options_.reach_timeout_s, options_.clocks) {
  options_.validate();
}

CommitmentProtocol::State CommitmentProtocol::state() const {
  if (listening_) return State::kListening;
  if (pending_) return binding_.empty() ? State::kProposing : State::kRevising;
  return binding_.empty() ? State::kIdle : State::kBound;
}

CommitmentActions CommitmentProtocol::propose(const Proposal& proposal, double now) {
  CommittedTrajectory trajectory = trajectory_of(proposal, TrajectoryState::kProposed);
  require_in_reach(*proposal.motion, now);
  CommitmentActions actions;
  listen(now);
  if (pending_) drop_pending(CommitmentEvent::Kind::kWithdrawn, Refusal::kReplaced, {}, actions);
  CommitmentEvent event = event_of(CommitmentEvent::Kind::kRejected, trajectory, proposal);
  event.refusal = refusal_by_itself(*proposal.motion, now);
  if (event.refusal == Refusal::kNone) {
    const Objection found = meetings(now).objection(trajectory, peers_);
    event.refusal = found.refusal;
    event.conflict = found.conflict;
  }
  if (event.refusal == Refusal::kNone) {
    pending_ = Pending{send(std::move(trajectory), actions), proposal, now};
  } else {
    actions.events.push_back(std::move(event));
  }
  advance(now, actions);
  return actions;
}

CommitmentActions CommitmentProtocol::brake(const Proposal& proposal, double now) {
  CommittedTrajectory trajectory = trajectory_of(proposal, TrajectoryState::kEmergency);
  CommitmentActions actions;
  listen(now);
  if (pending_) drop_pending(CommitmentEvent::Kind::kWithdrawn, Refusal::kEmergency, {}, actions);
  trajectory = send(std::move(trajectory), actions);
  binding_.bind(trajectory);
  actions.events.push_back(event_of(CommitmentEvent::Kind::kSettled, trajectory, proposal));
  advance(now, actions);
  return actions;
}

CommitmentActions CommitmentProtocol::receive(const CommittedTrajectory& trajectory, double now) {
  CommitmentActions actions;
  listen(now);
  if (trajectory.agent == options_.agent) {
    ++impostors_;
    return actions;
  }
  if (peers_.receive(trajectory, now) == PeerTable::Verdict::kNews) {
    if (is_binding(trajectory.state)) report_breach(trajectory.agent, now, actions);
    heed(trajectory.agent, now, actions);
  }
  carry_on(now, actions);
  return actions;
}

CommitmentActions CommitmentProtocol::receive(const Heartbeat& heartbeat, double now) {
  CommitmentActions actions;
  listen(now);
  if (heartbeat.agent == options_.agent) {
    ++impostors_;
    return actions;
  }
  const PeerTable::Verdict verdict = peers_.receive(heartbeat, now);
  if (verdict == PeerTable::Verdict::kNews) {
    heed(heartbeat.agent, now, actions);
  } else if (verdict == PeerTable::Verdict::kAlive) {
    answer(heartbeat.agent, peers_.peers().at(heartbeat.agent),
           now);  // its clock may be known from now on
  }
  carry_on(now, actions);
  return actions;
}

CommitmentActions CommitmentProtocol::tick(double now) {
  CommitmentActions actions;
  listen(now);
  advance(now, actions);
  return actions;
}

CommittedTrajectory CommitmentProtocol::trajectory_of(const Proposal& proposal,
                                                      TrajectoryState state) const {
  CommittedTrajectory trajectory;
  trajectory.agent = options_.agent;
  trajectory.id = {options_.epoch, sequence_ + 1};
  trajectory.state = state;
  trajectory.priority = options_.priority;
  trajectory.footprint_radius_m = proposal.footprint_radius_m;
  trajectory.braking = proposal.braking;
  trajectory.motion = proposal.motion;
  validate(trajectory);
  return trajectory;
}

CommittedTrajectory CommitmentProtocol::send(CommittedTrajectory trajectory,
                                             CommitmentActions& actions) {
  trajectory.id.sequence = ++sequence_;
  last_sent_ = {trajectory.agent, trajectory.id, trajectory.state};
  actions.trajectories.push_back(trajectory);
  return trajectory;
}

void CommitmentProtocol::listen(double now) {
  if (!listen_until_s_) listen_until_s_ = now + options_.reach_timeout_s;
  listening_ = now < *listen_until_s_;
}

/// Looks again at what the news of one peer can have changed: only its motions can be in the way
/// now that were not before, and only its proposal waits for an answer.
void CommitmentProtocol::heed(const std::string& name, double now, CommitmentActions& actions) {
  const Peer& peer = peers_.peers().at(name);
  if (pending_) {
    const Objection found = meetings(now).objection(pending_->trajectory, name, peer);
    if (found.refusal != Refusal::kNone) {
      drop_pending(CommitmentEvent::Kind::kRejected, found.refusal, found.conflict, actions);
    }
  }
  answer(name, peer, now);
}

void CommitmentProtocol::advance(double now, CommitmentActions& actions) {
  peers_.prune(now);
  answer(now);
  carry_on(now, actions);
}

void CommitmentProtocol::carry_on(double now, CommitmentActions& actions) {
  binding_.prune(now);
  if (pending_) settle(now, actions);
  if (!actions.events.empty()) answer(now);  // what was in the way of others may be no more
  keep_in_touch(now, actions);
}

void CommitmentProtocol::settle(double now, CommitmentActions& actions) {
  const bool late = now > pending_->trajectory.motion->start_time();
  if (!late && now < pending_->since_s + options_.delta_dc_s) return;
  Conflict missing;
  missing.peer = unaware_peer(pending_->trajectory.id, now);
  const std::string unclocked = unclocked_peer(now);
  if (!late && !(missing.peer.empty() && unclocked.empty())) return;
  const Objection found = meetings(now).objection(pending_->trajectory, peers_);
  if (found.refusal != Refusal::kNone) {
    drop_pending(CommitmentEvent::Kind::kRejected, found.refusal, found.conflict, actions);
    return;
  }
  if (!found.waits_for.empty()) missing.peer = found.waits_for;
  if (!late && missing.peer.empty()) return bind_pending(actions);
  if (!late) return;
  Refusal refusal = missing.peer.empty() ? Refusal::kTooLate : Refusal::kUnanswered;
  if (!unclocked.empty()) {
    missing.peer = unclocked;
    refusal = Refusal::kClock;
  }
  drop_pending(CommitmentEvent::Kind::kRejected, refusal, missing, actions);
}

void CommitmentProtocol::bind_pending(CommitmentActions& actions) {
  CommittedTrajectory trajectory = pending_->trajectory;
  trajectory.state = TrajectoryState::kCommitted;
  last_sent_.state = trajectory.state;
  binding_.bind(trajectory);
  actions.trajectories.push_back(trajectory);
  actions.events.push_back(
      event_of(CommitmentEvent::Kind::kSettled, trajectory, pending_->proposal));
  pending_.reset();
}

void CommitmentProtocol::drop_pending(CommitmentEvent::Kind kind, Refusal refusal,
                                      const Conflict& conflict, CommitmentActions& actions) {
  CommitmentEvent event = event_of(kind, pending_->trajectory, pending_->proposal);
  event.refusal = refusal;
  event.conflict = conflict;
  actions.events.push_back(std::move(event));
  CommittedTrajectory withdrawal = pending_->trajectory;
  withdrawal.state = TrajectoryState::kWithdrawn;
  withdrawal.braking.reset();
  withdrawal.motion.reset();
  last_sent_.state = withdrawal.state;
  actions.trajectories.push_back(std::move(withdrawal));
  pending_.reset();
}

void CommitmentProtocol::answer(double now) {
  for (const auto& [name, peer] : peers_.peers()) answer(name, peer, now);
}

void CommitmentProtocol::answer(const std::string& name, const Peer& peer, double now) {
  const CommittedTrajectory* proposal = peer.unanswered();
  if (proposal == nullptr || !peers_.clock_known(peer, now)) return;
  const CommittedTrajectory* pending = pending_ ? &pending_->trajectory : nullptr;
  if (meetings(now).objects_to(peer, *proposal, pending)) return;
  peers_.endorse(name, *proposal);
  if (!neighbourhood(now).is_near(peer, kSpare_s)) return;
  answers_.push_back({name, proposal->id, proposal->state});
}

void CommitmentProtocol::keep_in_touch(double now, CommitmentActions& actions) {
  const bool periodic = now >= next_heartbeat_s_;
  const bool answers = !answers_.empty() && now >= next_answer_s_;
  if (!periodic && !answers) return;
  if (!answers_.empty()) next_answer_s_ = now + kAnswerPeriod_s;
  actions.heartbeat =
      Heartbeat{options_.agent, options_.epoch, now, answers_, {}, options_.reach.promise_m};
  if (periodic) lines_.add(peers_, neighbourhood(now), now, *actions.heartbeat);
  answers_.clear();
  if (!binding_.empty()) {
    const CommittedTrajectory& newest = binding_.newest();
    actions.heartbeat->acknowledgements.push_back({newest.agent, newest.id, newest.state});
  }
  if (sequence_ > 0 && !is_binding(last_sent_.state))
    actions.heartbeat->acknowledgements.push_back(last_sent_);
  if (periodic) send_again(now, actions);
}

void CommitmentProtocol::send_again(double now, CommitmentActions& actions) {
  next_heartbeat_s_ = now + options_.heartbeat_period_s;
  if (pending_ && pending_->since_s < now && !unaware_peer(pending_->trajectory.id, now).empty()) {
    actions.trajectories.push_back(pending_->trajectory);
  }
  if (binding_.empty()) return;
  if (now < next_resend_s_ && unaware_peer(binding_.newest().id, now).empty()) return;
  next_resend_s_ = now + options_.resend_period_s;
  for (const Reservation& reservation : binding_.reservations())
    actions.trajectories.push_back(reservation.trajectory);
}

void CommitmentProtocol::report_breach(const std::string& name, double now,
                                       CommitmentActions& actions) const {
  const Peer& peer = peers_.peers().at(name);
  for (const Reservation& mine : binding_.reservations()) {
    const auto conflict = meetings(now).with_promises(mine, peer);
    if (!conflict) continue;
    CommitmentEvent event = event_of(CommitmentEvent::Kind::kBreached, mine.trajectory, {});
    event.conflict = *conflict;
    actions.events.push_back(std::move(event));
    return;
  }
}

void CommitmentProtocol::require_in_reach(const Motion& motion, double now) const {
  Eigen::AlignedBox2d box = motion.box();
  if (!binding_.empty()) box.extend(binding_.box(now));
  const double leads_m = box.diagonal().norm();
  if (leads_m <= options_.reach.promise_m) return;
  throw std::invalid_argument("leads " + std::to_string(leads_m) + " m far, allowed is " +
                              std::to_string(options_.reach.promise_m) +
                              " m: beyond, robots could be met that are not heard");
}

Refusal CommitmentProtocol::refusal_by_itself(const Motion& motion, double now) const {
  if (listening_) return Refusal::kListening;
  if (motion.start_time() < now + options_.delta_dc_s) return Refusal::kTooLate;
  if (binding_.empty()) return Refusal::kNone;
  const Vector2 expected = binding_.position(motion.start_time());
  const Vector2 begins = motion.position(motion.start_time());
  return (begins - expected).norm() <= kContinuity_m ? Refusal::kNone : Refusal::kDiscontinuous;
}

std::string CommitmentProtocol::unaware_peer(TrajectoryId id, double now) const {
  const Neighbourhood here = neighbourhood(now);
  for (const auto& [name, peer] : peers_.peers()) {
    const bool aware = peer.of_us && !(peer.of_us->id < id);
    if (!aware && peers_.in_reach(peer, now) && here.is_near(peer)) return name;
  }
  return {};
}

std::string CommitmentProtocol::unclocked_peer(double now) const {
  const Neighbourhood here = neighbourhood(now);
  for (const auto& [name, peer] : peers_.peers()) {
    if (!peers_.clock_known(peer, now) && peers_.in_reach(peer, now) && here.is_near(peer))
      return name;
  }
  return {};
}

}  // namespace mocha
