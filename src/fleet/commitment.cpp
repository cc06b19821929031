#include "fleet/commitment.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "trajectory/separation.h"

namespace mocha {
namespace {

constexpr double kContinuity_m = 0.05;
/// Robots that are too close already may come no closer than now, up to this for rounding.
constexpr double kRounding_m = 1e-3;

void require(bool condition, const char* name, double value, const char* range) {
  if (condition) return;
  throw std::invalid_argument(std::string(name) + " = " + std::to_string(value) + ", allowed is " +
                              range);
}

CommitmentEvent event_of(CommitmentEvent::Kind kind, const Promise& promise,
                         const Proposal& proposal) {
  CommitmentEvent event;
  event.kind = kind;
  event.promise = promise;
  event.proposal = proposal;
  return event;
}

}  // namespace

const char* name_of(Refusal refusal) {
  switch (refusal) {
    case Refusal::kNone:
      return "none";
    case Refusal::kListening:
      return "listening";
    case Refusal::kTooLate:
      return "too_late";
    case Refusal::kDiscontinuous:
      return "discontinuous";
    case Refusal::kPeerPromise:
      return "peer_promise";
    case Refusal::kPeerProposal:
      return "peer_proposal";
    case Refusal::kUnanswered:
      return "unanswered";
    case Refusal::kClock:
      return "clock";
    case Refusal::kReplaced:
      return "replaced";
    case Refusal::kEmergency:
      return "emergency";
  }
  return "unknown";
}

Commitment::Commitment(CommitmentSettings settings)
    : settings_(std::move(settings)),
      peers_(settings_.agent, settings_.epoch, settings_.reach_timeout_s, settings_.clocks) {
  if (settings_.agent.empty()) throw std::invalid_argument("the robot has no name");
  require(settings_.delta_dc_s >= 0.0, "delta_dc", settings_.delta_dc_s, "0 s or more");
  require(settings_.peer_clearance_m >= 0.0, "peer_clearance", settings_.peer_clearance_m,
          "0 m or more");
  require(settings_.heartbeat_period_s > 0.0, "heartbeat period", settings_.heartbeat_period_s,
          "above 0 s");
  require(settings_.clocks.tolerance_s >= 0.0, "clock tolerance", settings_.clocks.tolerance_s,
          "0 s or more");
  require(settings_.clocks.max_error_s >= 0.0, "max_clock_error", settings_.clocks.max_error_s,
          "0 s or more");
  require(settings_.answer_period_s >= 0.0, "answer period", settings_.answer_period_s,
          "0 s or more");
  require(settings_.resend_period_s > 0.0, "resend period", settings_.resend_period_s, "above 0 s");
}

Commitment::State Commitment::state() const {
  if (listening_) return State::kListening;
  if (pending_) return binding_.empty() ? State::kProposing : State::kRevising;
  return binding_.empty() ? State::kIdle : State::kBound;
}

CommitmentActions Commitment::propose(const Proposal& proposal, double now) {
  Promise promise = promise_of(proposal, PromiseState::kProposed);
  CommitmentActions actions;
  listen(now);
  if (pending_) drop_pending(CommitmentEvent::Kind::kWithdrawn, Refusal::kReplaced, {}, actions);
  CommitmentEvent event = event_of(CommitmentEvent::Kind::kRejected, promise, proposal);
  event.refusal = refusal_by_itself(*proposal.motion, now);
  if (event.refusal == Refusal::kNone) {
    const Obstacle found = obstacle(promise, now);
    event.refusal = found.refusal;
    event.conflict = found.conflict;
  }
  if (event.refusal == Refusal::kNone) {
    pending_ = Pending{send(std::move(promise), actions), proposal, now};
  } else {
    actions.events.push_back(std::move(event));
  }
  advance(now, actions);
  return actions;
}

CommitmentActions Commitment::brake(const Proposal& proposal, double now) {
  Promise promise = promise_of(proposal, PromiseState::kEmergency);
  CommitmentActions actions;
  listen(now);
  if (pending_) drop_pending(CommitmentEvent::Kind::kWithdrawn, Refusal::kEmergency, {}, actions);
  promise = send(std::move(promise), actions);
  binding_.bind(promise);
  actions.events.push_back(event_of(CommitmentEvent::Kind::kSettled, promise, proposal));
  advance(now, actions);
  return actions;
}

CommitmentActions Commitment::receive(const Promise& promise, double now) {
  CommitmentActions actions;
  listen(now);
  if (promise.agent == settings_.agent) {
    ++impostors_;
    return actions;
  }
  if (peers_.receive(promise, now) == PeerTable::Verdict::kNews) {
    if (is_binding(promise.state)) report_breach(promise.agent, now, actions);
    heed(promise.agent, now, actions);
  }
  carry_on(now, actions);
  return actions;
}

CommitmentActions Commitment::receive(const Beat& beat, double now) {
  CommitmentActions actions;
  listen(now);
  if (beat.agent == settings_.agent) {
    ++impostors_;
    return actions;
  }
  const PeerTable::Verdict verdict = peers_.receive(beat, now);
  if (verdict == PeerTable::Verdict::kNews) {
    heed(beat.agent, now, actions);
  } else if (verdict == PeerTable::Verdict::kAlive) {
    answer(beat.agent, peers_.peers().at(beat.agent), now);  // its clock may be known from now on
  }
  carry_on(now, actions);
  return actions;
}

CommitmentActions Commitment::tick(double now) {
  CommitmentActions actions;
  listen(now);
  advance(now, actions);
  return actions;
}

Promise Commitment::promise_of(const Proposal& proposal, PromiseState state) const {
  Promise promise;
  promise.agent = settings_.agent;
  promise.id = {settings_.epoch, sequence_ + 1};
  promise.state = state;
  promise.priority = settings_.priority;
  promise.footprint_radius_m = proposal.footprint_radius_m;
  promise.motion = proposal.motion;
  validate(promise);
  return promise;
}

Promise Commitment::send(Promise promise, CommitmentActions& actions) {
  promise.id.sequence = ++sequence_;
  last_sent_ = {promise.agent, promise.id, promise.state};
  actions.promises.push_back(promise);
  return promise;
}

void Commitment::listen(double now) {
  if (!listen_until_s_) listen_until_s_ = now + settings_.reach_timeout_s;
  listening_ = now < *listen_until_s_;
}

/// Looks again at what the news of one peer can have changed: only its motions can be in the way
/// now that were not before, and only its proposal waits for an answer.
void Commitment::heed(const std::string& name, double now, CommitmentActions& actions) {
  const Peer& peer = peers_.peers().at(name);
  if (pending_) {
    const Obstacle found = obstacle_by(name, peer, claim_of(pending_->promise), now);
    if (found.refusal != Refusal::kNone) {
      drop_pending(CommitmentEvent::Kind::kRejected, found.refusal, found.conflict, actions);
    }
  }
  answer(name, peer, now);
}

void Commitment::advance(double now, CommitmentActions& actions) {
  peers_.prune(now);
  answer(now);
  carry_on(now, actions);
}

void Commitment::carry_on(double now, CommitmentActions& actions) {
  binding_.prune(now);
  if (pending_) settle(now, actions);
  if (!actions.events.empty()) answer(now);  // what was in the way of others may be no more
  keep_in_touch(now, actions);
}

void Commitment::settle(double now, CommitmentActions& actions) {
  const bool late = now > pending_->promise.motion->start_time();
  if (!late && now < pending_->since_s + settings_.delta_dc_s) return;
  Conflict missing;
  missing.peer = unaware_peer(pending_->promise.id, now);
  const std::string unclocked = unclocked_peer(now);
  if (!late && !(missing.peer.empty() && unclocked.empty())) return;
  const Obstacle found = obstacle(pending_->promise, now);
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

void Commitment::bind_pending(CommitmentActions& actions) {
  Promise promise = pending_->promise;
  promise.state = PromiseState::kCommitted;
  last_sent_.state = promise.state;
  binding_.bind(promise);
  actions.promises.push_back(promise);
  actions.events.push_back(event_of(CommitmentEvent::Kind::kSettled, promise, pending_->proposal));
  pending_.reset();
}

void Commitment::drop_pending(CommitmentEvent::Kind kind, Refusal refusal, const Conflict& conflict,
                              CommitmentActions& actions) {
  CommitmentEvent event = event_of(kind, pending_->promise, pending_->proposal);
  event.refusal = refusal;
  event.conflict = conflict;
  actions.events.push_back(std::move(event));
  Promise withdrawal = pending_->promise;
  withdrawal.state = PromiseState::kWithdrawn;
  withdrawal.motion.reset();
  last_sent_.state = withdrawal.state;
  actions.promises.push_back(std::move(withdrawal));
  pending_.reset();
}

void Commitment::answer(double now) {
  for (const auto& [name, peer] : peers_.peers()) answer(name, peer, now);
}

void Commitment::answer(const std::string& name, const Peer& peer, double now) {
  const Promise* proposal = peer.unanswered();
  if (proposal == nullptr || !peers_.clock_known(peer, now) || objects_to(peer, *proposal, now))
    return;
  peers_.endorse(name, *proposal);
  answers_.push_back({name, proposal->id, proposal->state});
}

void Commitment::keep_in_touch(double now, CommitmentActions& actions) {
  const bool periodic = now >= next_beat_s_;
  const bool answers = !answers_.empty() && now >= next_answer_s_;
  if (!periodic && !answers) return;
  if (!answers_.empty()) next_answer_s_ = now + settings_.answer_period_s;
  actions.beat =
      periodic ? Beat{settings_.agent, settings_.epoch, now, peers_.seen(now), peers_.echoes(now)}
               : Beat{settings_.agent, settings_.epoch, now, answers_, {}};
  answers_.clear();
  if (!binding_.empty()) {
    const Promise& newest = binding_.newest();
    actions.beat->seen.push_back({newest.agent, newest.id, newest.state});
  }
  if (sequence_ > 0 && !is_binding(last_sent_.state)) actions.beat->seen.push_back(last_sent_);
  if (periodic) send_again(now, actions);
}

void Commitment::send_again(double now, CommitmentActions& actions) {
  next_beat_s_ = now + settings_.heartbeat_period_s;
  if (pending_ && pending_->since_s < now && !unaware_peer(pending_->promise.id, now).empty()) {
    actions.promises.push_back(pending_->promise);
  }
  if (binding_.empty()) return;
  if (now < next_resend_s_ && unaware_peer(binding_.newest().id, now).empty()) return;
  next_resend_s_ = now + settings_.resend_period_s;
  for (const Claim& claim : binding_.claims()) actions.promises.push_back(claim.promise);
}

void Commitment::report_breach(const std::string& name, double now,
                               CommitmentActions& actions) const {
  const Peer& peer = peers_.peers().at(name);
  for (const Claim& mine : binding_.claims()) {
    for (const Claim& theirs : peer.binding.claims()) {
      const auto conflict = meeting(mine, peer, theirs, now);
      if (!conflict) continue;
      CommitmentEvent event = event_of(CommitmentEvent::Kind::kBreached, mine.promise, {});
      event.conflict = *conflict;
      actions.events.push_back(std::move(event));
      return;
    }
  }
}

Refusal Commitment::refusal_by_itself(const Motion& motion, double now) const {
  if (listening_) return Refusal::kListening;
  if (motion.start_time() < now + settings_.delta_dc_s) return Refusal::kTooLate;
  if (binding_.empty()) return Refusal::kNone;
  const Vector2 expected = binding_.position(motion.start_time());
  const Vector2 begins = motion.position(motion.start_time());
  return (begins - expected).norm() <= kContinuity_m ? Refusal::kNone : Refusal::kDiscontinuous;
}

Commitment::Obstacle Commitment::obstacle(const Promise& proposal, double now) const {
  const Claim mine = claim_of(proposal);
  Obstacle found;
  for (const auto& [name, peer] : peers_.peers()) {
    Obstacle by_peer = obstacle_by(name, peer, mine, now);
    if (by_peer.refusal != Refusal::kNone) return by_peer;
    if (!by_peer.waits_for.empty()) found.waits_for = name;
  }
  return found;
}

Commitment::Obstacle Commitment::obstacle_by(const std::string& name, const Peer& peer,
                                             const Claim& mine, double now) const {
  for (const Claim& theirs : peer.binding.claims()) {
    const auto conflict = meeting(mine, peer, theirs, now);
    if (conflict) return {Refusal::kPeerPromise, *conflict, {}};
  }
  Obstacle found;
  for (const Promise& open : peer.open) {
    const auto conflict = meeting(mine, peer, peer.claim_of_open(open), now);
    if (!conflict) continue;
    if (outranks(open, mine.promise)) return {Refusal::kPeerProposal, *conflict, {}};
    found.waits_for = name;
  }
  return found;
}

bool Commitment::objects_to(const Peer& peer, const Promise& proposal, double now) const {
  const Claim theirs = peer.claim_of_open(proposal);
  for (const Claim& mine : binding_.claims()) {
    if (meeting(mine, peer, theirs, now)) return true;
  }
  return pending_ && outranks(pending_->promise, proposal) &&
         meeting(claim_of(pending_->promise), peer, theirs, now);
}

std::optional<Conflict> Commitment::meeting(const Claim& mine, const Peer& peer,
                                            const Claim& theirs, double now) const {
  const double demanded = mine.promise.footprint_radius_m + theirs.promise.footprint_radius_m +
                          settings_.peer_clearance_m;
  if (far_apart(*mine.promise.motion, *theirs.promise.motion, demanded)) return std::nullopt;
  const Vector2 here =
      binding_.empty() ? mine.promise.motion->position(now) : binding_.position(now);
  const Vector2 there =
      peer.binding.empty() ? theirs.promise.motion->position(now) : peer.binding.position(now);
  const double required = std::min(demanded, (here - there).norm() - kRounding_m);
  return first_conflict(mine, theirs, required, now);
}

std::string Commitment::unaware_peer(PromiseId id, double now) const {
  for (const auto& [name, peer] : peers_.peers()) {
    const bool aware = peer.of_us && !(peer.of_us->id < id);
    if (!aware && peers_.in_reach(peer, now)) return name;
  }
  return {};
}

std::string Commitment::unclocked_peer(double now) const {
  for (const auto& [name, peer] : peers_.peers()) {
    if (peers_.in_reach(peer, now) && !peers_.clock_known(peer, now)) return name;
  }
  return {};
}

}  // namespace mocha
