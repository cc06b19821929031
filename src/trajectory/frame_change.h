#pragma once

#include <Eigen/Geometry>

#include "trajectory/motion.h"

namespace mocha {

/// A pose that is given in a frame which itself stands at `frame`, in that frame's parent.
inline Pose composed(const Pose& frame, const Pose& pose) {
  return {frame.position + Eigen::Rotation2Dd(frame.yaw_rad) * pose.position,
          wrap_angle(frame.yaw_rad + pose.yaw_rad)};
}

/// A pose as seen from `frame`, both given in the same parent.
inline Pose relative(const Pose& frame, const Pose& pose) {
  return {Eigen::Rotation2Dd(-frame.yaw_rad) * (pose.position - frame.position),
          wrap_angle(pose.yaw_rad - frame.yaw_rad)};
}

}  // namespace mocha
