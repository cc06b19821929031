#pragma once

#include <mocha_ugv/FleetTrajectories.h>
#include <ros/node_handle.h>

#include <memory>
#include <string>
#include <vector>

#include "world/moving/moving_obstacle.h"

namespace mocha {

/// What the team-mates have promised, as moving obstacles: one for each motion of each of them.
class PeerSource {
 public:
  /// `own_name` is passed over. Messages in another frame than `frame`, and motions that are not
  /// valid, are refused and counted; a peer one of whose motions is refused keeps its former ones.
  PeerSource(ros::NodeHandle& node, std::string own_name, std::string frame);

  const std::vector<std::shared_ptr<const MovingObstacle>>& obstacles() const { return obstacles_; }
  /// Since the stamp of the newest message [s]; infinity before the first.
  double age_s(ros::Time now) const;
  int refused() const { return refused_; }

 private:
  void on_fleet(const mocha_ugv::FleetTrajectories& fleet);
  void refuse(const std::string& why);

  std::string own_name_;
  std::string frame_;
  std::vector<std::shared_ptr<const MovingObstacle>> obstacles_;
  ros::Time stamp_;
  int refused_ = 0;
  ros::Subscriber fleet_;
};

}  // namespace mocha
