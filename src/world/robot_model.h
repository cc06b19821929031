#pragma once

#include <limits>
#include <string>

#include "trajectory/braking.h"
#include "world/footprint.h"

namespace mocha {

/// What a motion may ask of the robot. SI units.
struct MotionLimits {
  double max_speed = 1.0;             ///< [m/s]
  double max_acceleration = 1.0;      ///< [m/s^2] of the base, along and across together
  double max_yaw_rate = 1.5;          ///< [rad/s]
  double max_yaw_acceleration = 4.0;  ///< [rad/s^2] of turns in place
  /// [m/s] of the faster wheel's rim: |v| + track / 2 |omega|.
  double max_wheel_speed = std::numeric_limits<double>::infinity();
  double track_m = 0.0;     ///< distance between left and right wheels
  bool can_reverse = true;  ///< drives backward, too

  /// Whether the wheels can do the highest speed and the highest yaw rate together, so that their
  /// limit needs no attention of its own.
  bool wheels_are_ample() const {
    return max_speed + 0.5 * track_m * max_yaw_rate <= max_wheel_speed;
  }
};

/// Contributions to the room that is kept around the body.
struct Margins {
  double tracking_m;        ///< e_track: base off its motion, at the highest speed
  double localisation_m;    ///< pose off the truth
  double map_m;             ///< obstacle nearer than its map cells, met at the highest speed
  double clock_s;           ///< own clock against the fleet's
  double tracking_still_m;  ///< as tracking_m, at rest; between, grows as speed squared
  double map_still_m;       ///< as map_m, the same
};

struct LidarModel {
  Pose mount;                ///< in base_link
  double height_m;           ///< above the ground
  double field_of_view_rad;  ///< centred ahead; 2 pi is all round
  int beams;
  double min_range_m;
  double max_range_m;
  double rate_hz;
  double sweep_time_s;  ///< first beam to last
  double noise_m;       ///< standard deviation of a range
  double dropout;       ///< share of beams without return

  /// Whether its last beam is the neighbour of its first.
  bool sees_all_round() const;
  /// Whether a beam passes a point of the body frame [m].
  bool sees(const Vector2& in_body) const;
};

/// One kind of robot, as `config/robots/<model>.yaml` describes it.
struct RobotModel {
  std::string name;
  MotionLimits limits;
  double max_wheel_acceleration;  ///< [m/s^2] rim
  double emergency_acceleration;  ///< [m/s^2] of the base, in emergency motions
  double actuator_lag_s;
  double cmd_timeout_s;
  Footprint footprint;
  LidarModel lidar;
  Margins margins;
  double peer_clearance_m;    ///< kept between the discs of two robots, on top of the margins
  bool stops_checked;         ///< promises keep robots apart where one of them brakes, too
  double peer_reaction_s;     ///< from a robot's braking until its peers brake because of it
  double moving_clearance_m;  ///< kept from people and the like, on top of the own margins
  double map_resolution_m;
  double odometry_noise_distance;  ///< [m/sqrt(m)]
  double odometry_noise_yaw;       ///< [rad/sqrt(rad)]

  /// Whether it may drive backward: where its lidar does not look, somebody may come.
  bool may_back() const { return limits.can_reverse && lidar.sees_all_round(); }
  /// Braking in good time: the braking motion stays within the limits. Whole mm/s^2, so that peers
  /// are told exactly what is driven.
  Braking braking() const;
  /// Braking where that comes too late: within emergency_limits(), for what a braking curve adds
  /// between its knots.
  Braking hard_braking() const;
  /// What an emergency motion may ask of the robot.
  MotionLimits emergency_limits() const;
};

/// Loads `<config_directory>/robots/<model>.yaml` under the schema `<config_directory>/robot.yaml`.
/// Throws ParameterError for unknown models and keys, values out of range, a speed or a yaw rate
/// that the wheels cannot deliver, a footprint that is none, sweeps that overlap, margins that are
/// larger at rest than at speed, and a base that cannot turn in place (min_turning_radius): plans
/// begin, end and change course with turns in place.
RobotModel load_robot_model(const std::string& config_directory, const std::string& model);

}  // namespace mocha
