#pragma once

#include <mocha_ugv/FleetTrajectories.h>

#include <set>
#include <string>
#include <vector>

#include "perception/tracking/peer_tracks.h"

namespace mocha {

/// What a FleetTrajectories says of the team-mates.
struct PeerReading {
  std::vector<PeerMotion> motions;  ///< of each peer in order of time
  std::set<std::string> refused;    ///< names of the peers of which a motion is not valid
  std::string why;                  ///< the last of these was refused
};

/// The binding motions in the message, but for those of `own_name`. A motion without a name, that
/// binds nothing, is no motion, or has a radius outside (0, 100) m, braking that no robot can have
/// or times that may be wrong by 100 s is refused. Throws std::invalid_argument for a message in
/// another frame than `frame`, or one that does not say of each motion how mistimed it may be.
PeerReading peers_of(const mocha_ugv::FleetTrajectories& message, const std::string& own_name,
                     const std::string& frame);

}  // namespace mocha
