#include "ros_bridge/inputs/peer_source.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

#include "ros_bridge/inputs/peer_motions.h"
#include "ros_bridge/runtime/transport.h"

namespace mocha {

PeerSource::PeerSource(ros::NodeHandle& node, std::string own_name, std::string frame)
    : own_name_(std::move(own_name)), frame_(std::move(frame)) {
  fleet_ = node.subscribe("fleet/trajectories", 1, &PeerSource::on_fleet, this, at_once());
}

void PeerSource::on_fleet(const mocha_ugv::FleetTrajectories& fleet) {
  try {
    const PeerReading reading = peers_of(fleet, own_name_, frame_);
    std::vector<std::shared_ptr<const MovingObstacle>> obstacles;
    for (const PeerMotion& peer : reading.motions)
      obstacles.push_back(std::make_shared<PeerObstacle>(peer.name, peer.motion, peer.radius_m,
                                                         peer.braking, peer.mistimed_s));
    for (const std::string& name : reading.refused) {
      std::copy_if(obstacles_.begin(), obstacles_.end(), std::back_inserter(obstacles),
                   [&](const auto& former) { return former->name() == name; });
    }
    obstacles_ = std::move(obstacles);
    stamp_ = fleet.header.stamp;
    if (!reading.refused.empty()) refuse(reading.why);
  } catch (const std::invalid_argument& error) {
    refuse(error.what());
  }
}

void PeerSource::refuse(const std::string& why) {
  ++refused_;
  ROS_WARN_THROTTLE(5.0, "Refused what came on fleet/trajectories: %s", why.c_str());
}

double PeerSource::age_s(ros::Time now) const {
  return stamp_.isZero() ? std::numeric_limits<double>::infinity() : (now - stamp_).toSec();
}

}  // namespace mocha
