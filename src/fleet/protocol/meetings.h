#pragma once

#include <optional>
#include <string>

#include "fleet/protocol/commitment_event.h"
#include "fleet/protocol/commitment_options.h"
#include "fleet/protocol/peer_table.h"

namespace mocha {

/// What stands between a proposal of ours and its settlement.
struct Objection {
  Refusal refusal = Refusal::kNone;
  Conflict conflict;
  std::string waits_for;  ///< a peer whose outranked proposal is not withdrawn yet
};

/// Which motions of a robot and of its peers meet at one moment, by the rules of
/// CommitmentProtocol. The options and what is binding for the robot must outlive it.
class Meetings {
 public:
  Meetings(const CommitmentOptions& options, const ReservationChain& binding, double now)
      : options_(options), binding_(binding), now_(now) {}

  /// Where a motion of ours meets one that the peer has promised.
  std::optional<Conflict> with_promises(const Reservation& mine, const Peer& peer) const;

  /// What stands between our proposal and its settlement: of one peer, or of all.
  Objection objection(const CommittedTrajectory& proposal, const std::string& name,
                      const Peer& peer) const;
  Objection objection(const CommittedTrajectory& proposal, const PeerTable& peers) const;

  /// Whether the peer's proposal meets our promise, or our pending proposal (which may be none) of
  /// higher rank.
  bool objects_to(const Peer& peer, const CommittedTrajectory& proposal,
                  const CommittedTrajectory* pending) const;

 private:
  std::optional<Conflict> between(const Reservation& mine, const Peer& peer,
                                  const Reservation& theirs) const;
  /// The same for where one of them brakes: of what is binding, and the proposals where there are.
  std::optional<Conflict> by_stopping(const CommittedTrajectory* my_proposal, const Peer& peer,
                                      const CommittedTrajectory* their_proposal) const;
  /// By how much the peer's motion may be early or late beyond what margins allow for.
  double mistimed_s(const Peer& peer, const Motion& theirs) const;
  /// Robots that are too close already may come as close as this, and no closer.
  double closest_m(const Motion& mine, const Peer& peer, const Motion& theirs) const;

  const CommitmentOptions& options_;
  const ReservationChain& binding_;
  double now_;
};

}  // namespace mocha
