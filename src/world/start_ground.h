#pragma once

#include "world/robot_model.h"

namespace mocha {

/// The ground that counts as free where a robot starts, though nothing has seen it yet: what is
/// under the body and its margin; and what its lidar cannot see from there of the ground that the
/// body may take to back out of a dead end half as deep again as it is long, and to turn. Both grow
/// by a cell of the map, for that one's rounding.
class StartGround {
 public:
  explicit StartGround(const RobotModel& robot);

  /// The part of it that is under the body and its margin.
  StartGround under_body() const;

  /// Whether a point belongs to it; body frame [m].
  bool contains(const Vector2& in_body) const;
  bool is_under_body(const Vector2& in_body) const { return footprint_.depth_m(in_body) >= 0.0; }
  /// Radius of a disc about the base that holds all of it [m].
  double reach_m() const { return reach_m_; }

 private:
  Footprint footprint_;
  LidarModel lidar_;
  double around_body_m_;
  double reach_m_;
};

}  // namespace mocha
