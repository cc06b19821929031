#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "trajectory/motion.h"

namespace mocha {

/// The units of a lattice of a double integrator.
struct LatticeUnits {
  double step_s = 0.5;
  double push = 0.5;       ///< [m/s^2] along each axis; pushes are whole multiples of it
  double merged_m = 0.25;  ///< states this near at one velocity and time are one

  double length_m() const { return 0.5 * push * step_s * step_s; }
  double speed() const { return push * step_s; }  ///< [m/s]
};

/// Position, velocity and time in units of the lattice; of one that stands, its heading, in eighths
/// of a turn from the lattice's first axis, and for how many steps.
struct LatticeState {
  std::int16_t x = 0;
  std::int16_t y = 0;
  std::int8_t vx = 0;
  std::int8_t vy = 0;
  std::int16_t step = 0;
  std::int8_t heading = 0;
  std::int8_t rest = 0;

  bool stands() const { return vx == 0 && vy == 0; }
};

/// The lattice itself: its origin is where the robot starts, its first axis points where the robot
/// does.
class SpaceTimeLattice {
 public:
  /// Throws std::invalid_argument unless all units are positive, and the turn of a robot that
  /// stands takes no more steps than a state can count.
  SpaceTimeLattice(const LatticeUnits& units, const Pose& start, double start_time_s,
                   double max_yaw_rate, bool can_reverse);

  const LatticeUnits& units() const { return units_; }
  double time_s(const LatticeState& state) const {
    return start_time_s_ + state.step * units_.step_s;
  }
  Vector2 place(const LatticeState& state) const {
    return start_.position + axes_ * (units_.length_m() * Vector2(state.x, state.y));
  }
  Vector2 velocity(const LatticeState& state) const {
    return axes_ * (units_.speed() * Vector2(state.vx, state.vy));
  }
  /// [m/s^2]
  Vector2 push(int ax, int ay) const { return axes_ * (units_.push * Vector2(ax, ay)); }

  /// At rest at a start, or driving ahead there, at the lattice's speed nearest to `speed`.
  LatticeState start(double speed) const;
  LatticeState pushed(const LatticeState& state, int ax, int ay) const;
  /// Heading of a robot at rest whose yaw is `yaw_rad`.
  int heading_of(double yaw_rad) const;
  /// Whether the direction of travel changes slowly enough. A robot that stands has to turn first,
  /// so that its front, or its back if it can reverse, points where it goes; a turn from rest to
  /// rest takes 15/8 of what it would at the highest rate.
  bool turns(const LatticeState& from, const LatticeState& to) const;
  /// The same for states that are one; `exactly` sets each state apart.
  std::uint64_t key(const LatticeState& state, bool exactly) const;

 private:
  int turning_steps(int eighths) const;

  LatticeUnits units_;
  Pose start_;
  Eigen::Matrix2d axes_;
  double start_time_s_;
  double max_yaw_rate_;
  bool can_reverse_;
  int merged_units_;
  int longest_rest_;  // steps; after these, one may leave in any direction
};

}  // namespace mocha
