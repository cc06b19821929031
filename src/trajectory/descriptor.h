#pragma once

#include <Eigen/Core>
#include <vector>

#include "trajectory/motion.h"

namespace mocha {

/// The minimal description of one phase: what is broadcast and stored. Map frame, SI units.
struct PhaseDescriptor {
  enum class Kind { kTurn = 0, kDrive = 1, kStand = 2 };

  Kind kind = Kind::kStand;
  int direction = 0;                ///< kDrive: +1 or -1
  double yaw_start_rad = 0.0;       ///< kTurn, kStand
  double yaw_change_rad = 0.0;      ///< kTurn
  TurnRates start_rates = {};       ///< kTurn
  TurnRates end_rates = {};         ///< kTurn
  std::vector<double> durations_s;  ///< kDrive: one a piece; otherwise one
  std::vector<Vector2> points;      ///< kDrive: start, interior knots, end; otherwise one
  Eigen::Matrix<double, 2, 2> start_derivatives =
      Eigen::Matrix2d::Zero();  ///< columns: velocity, acceleration
  Eigen::Matrix<double, 2, 2> end_derivatives = Eigen::Matrix2d::Zero();
};

struct MotionDescriptor {
  double start_time_s = 0.0;
  std::vector<PhaseDescriptor> phases;
};

/// A drive that was cut less than 50 ms before or after a knot is told without that knot.
MotionDescriptor describe(const Motion& motion);

/// Rebuilds the motion. Throws std::invalid_argument, saying what is wrong, for anything that is
/// not a valid motion: sizes that do not fit, values that are not finite, durations that are not
/// positive, jumps, no rest at the end.
Motion rebuild(const MotionDescriptor& descriptor);

}  // namespace mocha
