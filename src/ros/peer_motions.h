#pragma once

#include <mocha_ugv/FleetTrajectories.h>

#include <vector>

#include "perception/peer_tracks.h"
#include "ros/scan_queue.h"

namespace mocha {

/// The motions of the team-mates; those that are not valid are left out and counted.
std::vector<PeerMotion> peers_of(const mocha_ugv::FleetTrajectories& message, Refusals& refusals);

}  // namespace mocha
