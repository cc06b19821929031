#pragma once

#include "config/parameter_table.h"
#include "world/robot_model.h"

namespace mocha {

/// How far robots of a fleet hear each other, and how far they promise, for that.
///
/// From any moment on, all that a robot has promised or proposes lies within `promise_m` of where
/// it is then. So the promises of two robots can meet only while they are closer than both of these
/// and what they keep apart; and with the bound below, two robots that can hear each other over
/// `radio_range_m` have done so for a reach timeout before that, however fast they come: nobody is
/// met unheard.
struct Reach {
  double radio_range_m;
  double fleet_speed;  ///< [m/s] of the fastest robot of the fleet
  double promise_m;

  /// The promises reach as far as the horizon asks, or less, where
  ///
  ///   2 promise_m <= radio_range_m - apart_m - 2 fleet_speed reach_timeout
  ///
  /// is less. `values` are those of config/trajectory_broadcaster.yaml, the horizon is that of the
  /// local replanner. Throws std::invalid_argument for a robot that is faster than its fleet, and
  /// where there is no room left to stop from its highest speed.
  static Reach from(const ParameterTable& values, const RobotModel& robot, double horizon_s);
};

}  // namespace mocha
