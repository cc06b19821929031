#pragma once

#include "simulation/vehicle.h"
#include "world/robot_model.h"

namespace mocha {

/// Tells whose fault a contact is, by passive safety: never that of a robot that stands.
enum class Blame {
  kOwn,       ///< the robot's: it moved, faster than 0.1 m/s where it was touched
  kStanding,  ///< it stood
  kUnseen     ///< it moved, but what it touched came from where its lidar does not look
};

const char* to_text(Blame blame);

/// How two bodies meet.
struct Touch {
  Vector2 place;           ///< map frame [m]
  Vector2 own_velocity;    ///< of the robot there [m/s]
  Vector2 other_velocity;  ///< of the other body there [m/s]
  Vector2 towards;         ///< the other body, from the robot: a unit vector

  /// How fast they come together [m/s].
  double approach_mps() const { return (own_velocity - other_velocity).dot(towards); }
};

/// The velocity of a robot's body at a place of the map frame [m/s].
Vector2 velocity_at(const Vector2& place, const Pose& base, const Twist& twist);

/// For the robot with this lidar, whose base is at `base`.
Blame blame_of(const Touch& touch, const Pose& base, const LidarModel& lidar);

}  // namespace mocha
