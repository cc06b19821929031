#pragma once

#include <cstdint>

#include "fleet/protocol/commitment_event.h"
#include "fleet/protocol/committed_trajectory.h"
#include "fleet/protocol/peer_table.h"
#include "fleet/protocol/reservation_chain.h"

namespace mocha {

/// How a robot's proposals become promises. Time is an argument, which must not decrease; messages
/// go in and come out.
class SettlingProtocol {
 public:
  virtual ~SettlingProtocol() = default;

  virtual CommitmentActions propose(const Proposal& proposal, double now) = 0;
  /// Makes a braking motion binding at once.
  virtual CommitmentActions brake(const Proposal& proposal, double now) = 0;
  virtual CommitmentActions receive(const CommittedTrajectory& trajectory, double now) = 0;
  virtual CommitmentActions receive(const Heartbeat& heartbeat, double now) = 0;
  virtual CommitmentActions tick(double now) = 0;

  virtual std::uint32_t epoch() const = 0;
  virtual const PeerTable& peers() const = 0;
  /// What this robot has promised.
  virtual const ReservationChain& binding() const = 0;
};

}  // namespace mocha
