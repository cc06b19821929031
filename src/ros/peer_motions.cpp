#include "ros/peer_motions.h"

#include <memory>
#include <stdexcept>

#include "ros/conversions.h"

namespace mocha {

std::vector<PeerMotion> peers_of(const mocha_ugv::FleetTrajectories& message, Refusals& refusals) {
  std::vector<PeerMotion> peers;
  for (const auto& trajectory : message.trajectories) {
    try {
      if (!(trajectory.footprint_radius > 0.0 && trajectory.footprint_radius < 100.0)) {
        throw std::invalid_argument("footprint_radius must be above 0 and below 100 m");
      }
      peers.push_back({trajectory.agent,
                       {trajectory.epoch, trajectory.sequence},
                       std::make_shared<Motion>(from_message(trajectory)),
                       trajectory.footprint_radius});
    } catch (const std::exception& error) {
      refusals.add("fleet/trajectories", error.what());
    }
  }
  return peers;
}

}  // namespace mocha
