#pragma once

#include <mocha_ugv/Trajectory.h>
#include <ros/node_handle.h>

#include <string>

#include "trajectory/motion.h"

namespace mocha {

/// What the robot has promised to drive: the newest motion on `committed_trajectory`.
class CommittedTrajectorySource {
 public:
  /// Messages that are no motion are refused, counted and logged under `own_name`.
  CommittedTrajectorySource(ros::NodeHandle& node, std::string own_name);

  /// Empty before the first.
  const Motion& motion() const { return motion_; }
  int refused() const { return refused_; }

 private:
  void on_committed(const mocha_ugv::Trajectory& message);

  std::string own_name_;
  Motion motion_;
  int refused_ = 0;
  ros::Subscriber commitments_;
};

}  // namespace mocha
