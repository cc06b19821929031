#include "ros_bridge/inputs/peer_motions.h"

#include <memory>
#include <stdexcept>

#include "fleet/protocol/committed_trajectory.h"
#include "ros_bridge/messages/conversions.h"

namespace mocha {
namespace {

constexpr double kMostRadius_m = 100.0;
constexpr double kMostMistimed_s = 100.0;

PeerMotion peer_of(const mocha_ugv::Trajectory& trajectory, double mistimed_s) {
  if (trajectory.agent.empty()) throw std::invalid_argument("a motion has no name of a robot");
  if (!is_binding(static_cast<TrajectoryState>(trajectory.state))) {
    throw std::invalid_argument("state = " + std::to_string(trajectory.state) + " is not binding");
  }
  const double radius_m = trajectory.footprint_radius;
  if (!(radius_m > 0.0 && radius_m < kMostRadius_m)) {
    throw std::invalid_argument("footprint_radius = " + std::to_string(radius_m) +
                                " m, allowed is above 0 and below 100 m");
  }
  if (!(mistimed_s >= 0.0 && mistimed_s < kMostMistimed_s)) {
    throw std::invalid_argument("mistimed = " + std::to_string(mistimed_s) +
                                " s, allowed is 0 up to below 100 s");
  }
  const Braking braking = braking_from_message(trajectory);
  validate(braking);
  return {trajectory.agent,
          {trajectory.epoch, trajectory.sequence},
          std::make_shared<const Motion>(from_message(trajectory)),
          radius_m,
          braking,
          mistimed_s};
}

}  // namespace

PeerReading peers_of(const mocha_ugv::FleetTrajectories& message, const std::string& own_name,
                     const std::string& frame) {
  if (message.header.frame_id != frame) {
    throw std::invalid_argument("is in frame '" + message.header.frame_id + "', not in '" + frame +
                                "'");
  }
  if (message.mistimed.size() != message.trajectories.size())
    throw std::invalid_argument("has not one value of `mistimed` for each of its trajectories");
  PeerReading reading;
  for (std::size_t i = 0; i < message.trajectories.size(); ++i) {
    const auto& trajectory = message.trajectories[i];
    if (trajectory.agent == own_name) continue;
    try {
      reading.motions.push_back(peer_of(trajectory, message.mistimed[i]));
    } catch (const std::invalid_argument& error) {
      reading.refused.insert(trajectory.agent);
      reading.why = trajectory.agent + ": " + error.what();
    }
  }
  return reading;
}

}  // namespace mocha
