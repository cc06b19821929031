#include "benchmarks/one_phase.h"

#include <algorithm>
#include <utility>

namespace mocha {
namespace {

constexpr double kContinuity_m = 0.05;
constexpr double kRounding_m = 1e-3;  // a robot that is too close already may come no closer

}  // namespace

OnePhase::OnePhase(CommitmentOptions options)
    : options_(std::move(options)),
      peers_(options_.agent, options_.epoch, options_.reach_timeout_s, options_.clocks) {}

CommitmentActions OnePhase::propose(const Proposal& proposal, double now) {
  CommitmentActions actions = tick(now);
  CommitmentEvent event;
  event.kind = CommitmentEvent::Kind::kRejected;
  event.proposal = proposal;
  event.refusal = refusal_by_itself(*proposal.motion, now);
  if (event.refusal == Refusal::kNone) {
    for (const auto& [name, peer] : peers_.peers()) {
      const auto found = conflict(proposal, name, now);
      if (!found) continue;
      event.refusal = Refusal::kPeerPromise;
      event.conflict = *found;
    }
  }
  if (event.refusal == Refusal::kNone) event = bind(proposal, TrajectoryState::kCommitted, actions);
  actions.events.push_back(std::move(event));
  return actions;
}

CommitmentActions OnePhase::brake(const Proposal& proposal, double now) {
  CommitmentActions actions = tick(now);
  actions.events.push_back(bind(proposal, TrajectoryState::kEmergency, actions));
  return actions;
}

CommitmentActions OnePhase::receive(const CommittedTrajectory& promise, double now) {
  const bool news = peers_.receive(promise, now) == PeerTable::Verdict::kNews;
  CommitmentActions actions = tick(now);
  if (!news || !is_binding(promise.state) || binding_.empty()) return actions;
  const CommittedTrajectory& mine = binding_.newest();
  if (auto found =
          conflict({0, mine.footprint_radius_m, mine.braking, mine.motion}, promise.agent, now)) {
    CommitmentEvent event;
    event.kind = CommitmentEvent::Kind::kBreached;
    event.trajectory = mine;
    event.conflict = *found;
    actions.events.push_back(std::move(event));
  }
  return actions;
}

CommitmentActions OnePhase::receive(const Heartbeat&, double now) { return tick(now); }

CommitmentActions OnePhase::tick(double now) {
  if (!listen_until_s_) listen_until_s_ = now + options_.reach_timeout_s;
  peers_.prune(now);
  binding_.prune(now);
  CommitmentActions actions;
  if (binding_.empty() || now < next_resend_s_) return actions;
  next_resend_s_ = now + options_.resend_period_s;
  for (const Reservation& reservation : binding_.reservations())
    actions.trajectories.push_back(reservation.trajectory);
  return actions;
}

CommitmentEvent OnePhase::bind(const Proposal& proposal, TrajectoryState state,
                               CommitmentActions& actions) {
  CommittedTrajectory promise;
  promise.agent = options_.agent;
  promise.id = {options_.epoch, ++sequence_};
  promise.state = state;
  promise.footprint_radius_m = proposal.footprint_radius_m;
  promise.braking = proposal.braking;
  promise.motion = proposal.motion;
  binding_.bind(promise);
  actions.trajectories.push_back(promise);
  CommitmentEvent event;
  event.kind = CommitmentEvent::Kind::kSettled;
  event.trajectory = std::move(promise);
  event.proposal = proposal;
  return event;
}

Refusal OnePhase::refusal_by_itself(const Motion& motion, double now) const {
  if (now < *listen_until_s_) return Refusal::kListening;
  if (motion.start_time() < now) return Refusal::kTooLate;
  if (binding_.empty()) return Refusal::kNone;
  const Vector2 expected = binding_.position(motion.start_time());
  const Vector2 begins = motion.position(motion.start_time());
  return (begins - expected).norm() <= kContinuity_m ? Refusal::kNone : Refusal::kDiscontinuous;
}

std::optional<Conflict> OnePhase::conflict(const Proposal& proposal, const std::string& name,
                                           double now) const {
  const CommittedTrajectory mine{options_.agent,
                                 {},
                                 TrajectoryState::kProposed,
                                 0,
                                 proposal.footprint_radius_m,
                                 proposal.braking,
                                 proposal.motion};
  const Vector2 here = binding_.empty() ? proposal.motion->position(now) : binding_.position(now);
  const Peer& peer = peers_.peers().at(name);
  for (const Reservation& theirs : peer.binding.reservations()) {
    const double demanded = proposal.footprint_radius_m + theirs.trajectory.footprint_radius_m +
                            options_.peer_clearance_m;
    const double apart = (here - peer.binding.position(now)).norm();
    auto found =
        first_conflict(reservation_of(mine), theirs, std::min(demanded, apart - kRounding_m), now);
    if (found) return found;
  }
  return std::nullopt;
}

}  // namespace mocha
