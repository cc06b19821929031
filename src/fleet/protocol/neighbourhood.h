#pragma once

#include <optional>

#include "fleet/protocol/commitment_options.h"
#include "fleet/protocol/peer_table.h"

namespace mocha {

/// Which peers a robot has to settle with at one moment: those that can have promised, or be about
/// to promise, what its own promises meet (Reach). The options and what is binding for the robot
/// must outlive it.
class Neighbourhood {
 public:
  Neighbourhood(const CommitmentOptions& options, const ReservationChain& binding, double now)
      : options_(options), binding_(binding), now_(now) {}

  /// Centre to centre [m], as far as is known: nothing where one of the two has promised nothing
  /// yet.
  std::optional<double> distance_m(const Peer& peer) const;

  /// The peer is near, or may be: since its place was last confirmed, both may have left what they
  /// had promised. `spare_s`: as though its place had been confirmed so much earlier.
  bool is_near(const Peer& peer, double spare_s = 0.0) const;

  /// How often the peer is to be told what was heard of it: 1 where it is near, less the farther it
  /// is.
  double urgency(const Peer& peer) const;

 private:
  /// The distance [m] within which a peer is near whose place is known exactly.
  double near_m(const Peer& peer) const;

  const CommitmentOptions& options_;
  const ReservationChain& binding_;
  double now_;
};

}  // namespace mocha
