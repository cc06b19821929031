#include "ros/peer_source.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "ros/conversions.h"
#include "ros/transport.h"

namespace mocha {

PeerSource::PeerSource(ros::NodeHandle& node, std::string own_name, std::string frame)
    : own_name_(std::move(own_name)), frame_(std::move(frame)) {
  fleet_ = node.subscribe("fleet/trajectories", 1, &PeerSource::on_fleet, this, at_once());
}

std::shared_ptr<const MovingObstacle> PeerSource::former(const std::string& name) const {
  for (const auto& obstacle : obstacles_) {
    if (obstacle->name() == name) return obstacle;
  }
  return nullptr;
}

void PeerSource::on_fleet(const mocha_ugv::FleetTrajectories& fleet) {
  if (fleet.header.frame_id != frame_) {
    ++refused_;
    return;
  }
  std::vector<std::shared_ptr<const MovingObstacle>> obstacles;
  for (const auto& trajectory : fleet.trajectories) {
    if (trajectory.agent == own_name_) continue;
    try {
      if (!(trajectory.footprint_radius > 0.0) || !std::isfinite(trajectory.footprint_radius)) {
        throw std::invalid_argument("its radius is not positive");
      }
      auto motion = std::make_shared<const Motion>(from_message(trajectory));
      obstacles.push_back(std::make_shared<PeerObstacle>(trajectory.agent, std::move(motion),
                                                         trajectory.footprint_radius));
    } catch (const std::exception& error) {
      ++refused_;
      ROS_WARN_THROTTLE(5.0, "Refused the promise of %s: %s", trajectory.agent.c_str(),
                        error.what());
      if (auto kept = former(trajectory.agent)) obstacles.push_back(std::move(kept));
    }
  }
  obstacles_ = std::move(obstacles);
  stamp_ = fleet.header.stamp;
}

double PeerSource::age_s(ros::Time now) const {
  return stamp_.isZero() ? std::numeric_limits<double>::infinity() : (now - stamp_).toSec();
}

}  // namespace mocha
