#pragma once

#include <random>
#include <string>
#include <utility>
#include <vector>

#include "fleet/protocol/settling_protocol.h"

namespace mocha {

/// Stands in for settling with peers: every proposal is answered at the next tick, and a share of
/// those that are no emergencies is refused.
class LateAnswers : public SettlingProtocol {
 public:
  static constexpr const char* kAgent = "ugv1";

  double refused_share = 0.0;
  bool answers = true;  ///< else nothing is answered
  bool breach = false;  ///< what the peers promise meets the motion in force

  CommitmentActions propose(const Proposal& proposal, double) override {
    waiting_.emplace_back(proposal, false);
    return {};
  }
  CommitmentActions brake(const Proposal& proposal, double) override {
    waiting_.emplace_back(proposal, true);
    return {};
  }
  CommitmentActions receive(const CommittedTrajectory& promise, double now) override {
    peers_.receive(promise, now);
    if (!breach) return {};
    CommitmentEvent event;
    event.kind = CommitmentEvent::Kind::kBreached;
    return {{}, std::nullopt, {event}};
  }
  CommitmentActions receive(const Heartbeat&, double) override { return {}; }

  CommitmentActions tick(double now) override {
    CommitmentActions actions;
    if (!answers) return actions;
    for (const auto& [proposal, emergency] : std::exchange(waiting_, {})) {
      CommitmentEvent event;
      event.proposal = proposal;
      const bool refused = !emergency && share_(random_) < refused_share;
      event.kind = refused ? CommitmentEvent::Kind::kRejected : CommitmentEvent::Kind::kSettled;
      event.refusal = refused ? Refusal::kPeerPromise : Refusal::kNone;
      if (!refused) event.trajectory = bind(proposal, now);
      actions.events.push_back(event);
    }
    return actions;
  }

  /// Makes a motion binding.
  CommittedTrajectory bind(const Proposal& proposal, double now) {
    CommittedTrajectory promise;
    promise.agent = kAgent;
    promise.footprint_radius_m = proposal.footprint_radius_m;
    promise.braking = proposal.braking;
    promise.motion = proposal.motion;
    binding_.bind(promise);
    binding_.prune(now);
    return promise;
  }

  std::uint32_t epoch() const override { return 1; }
  const PeerTable& peers() const override { return peers_; }
  const ReservationChain& binding() const override { return binding_; }

 private:
  PeerTable peers_{kAgent, 1, 1.0, {0.0, 0.25}};
  ReservationChain binding_;
  std::vector<std::pair<Proposal, bool>> waiting_;
  std::uniform_real_distribution<double> share_{0.0, 1.0};
  std::mt19937 random_{11};
};

}  // namespace mocha
