#pragma once

#include "fleet/protocol/commitment_protocol.h"

namespace mocha {

/// The paper's protocol (paper IV-D 4), to be measured against: a trajectory that meets nothing
/// known so far is binding at once, and then broadcast. No robot is asked, so that of two robots
/// that promise within one message's delay neither knows of the other. Calls and answers are those
/// of CommitmentProtocol; what is in force is sent again every resend_period, heartbeats there are
/// none.
class OnePhase : public SettlingProtocol {
 public:
  /// Of the options, those about settling have no meaning.
  explicit OnePhase(CommitmentOptions options);

  CommitmentActions propose(const Proposal& proposal, double now) override;
  CommitmentActions brake(const Proposal& proposal, double now) override;
  CommitmentActions receive(const CommittedTrajectory& promise, double now) override;
  CommitmentActions receive(const Heartbeat& heartbeat, double now) override;
  CommitmentActions tick(double now) override;

  std::uint32_t epoch() const override { return options_.epoch; }
  const PeerTable& peers() const override { return peers_; }
  const ReservationChain& binding() const override { return binding_; }

 private:
  CommitmentEvent bind(const Proposal& proposal, TrajectoryState state, CommitmentActions& actions);
  Refusal refusal_by_itself(const Motion& motion, double now) const;
  std::optional<Conflict> conflict(const Proposal& proposal, const std::string& peer,
                                   double now) const;

  CommitmentOptions options_;
  PeerTable peers_;
  ReservationChain binding_;
  std::uint32_t sequence_ = 0;
  std::optional<double> listen_until_s_;
  double next_resend_s_ = 0.0;
};

}  // namespace mocha
