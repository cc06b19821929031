#pragma once

#include <cstddef>

#include "fleet/protocol/line_rota.h"
#include "fleet/protocol/neighbourhood.h"

namespace mocha {

/// Whom the periodic heartbeats of a robot speak of: of a few peers each, of near ones oftener, so
/// that what the robot sends does not grow with the fleet.
class HeartbeatLines {
 public:
  static constexpr std::size_t kMostAcknowledged = 12;  ///< what is endorsed
  static constexpr std::size_t kMostEchoed = 6;         ///< what was heard last

  /// Adds the lines about the peers whose turn it is.
  void add(const PeerTable& peers, const Neighbourhood& here, double now, Heartbeat& heartbeat);

 private:
  LineRota acknowledged_{kMostAcknowledged};
  LineRota echoed_{kMostEchoed};
};

}  // namespace mocha
