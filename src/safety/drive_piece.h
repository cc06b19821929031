#pragma once

#include <vector>

#include "trajectory/bernstein.h"
#include "trajectory/motion.h"

namespace mocha {

/// One polynomial piece of a drive in Bernstein form, by its own normalised time.
struct DrivePiece {
  double start_s;  ///< absolute
  double duration_s;
  int drive_direction;  ///< +1 or -1
  bool begins_or_ends_drive;
  Bernstein<2, 5> position;  ///< [m]
  Bernstein<2, 4> velocity;  ///< [m] by normalised time
  /// Has the direction of the velocity, also at the rests where the drive begins or ends: there the
  /// velocity's zeros are divided out.
  Bernstein<2, 4> course;

  double end_s() const { return start_s + duration_s; }
  double max_speed() const { return velocity.colwise().norm().maxCoeff() / duration_s; }
};

/// The pieces of the motion's drives from `from_s` (absolute) on; a piece under way at `from_s` is
/// cut there. `phase` is the index of a drive.
std::vector<DrivePiece> drive_pieces(const Motion& motion, int phase, double from_s);

}  // namespace mocha
