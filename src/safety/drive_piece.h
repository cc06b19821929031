#pragma once

#include <vector>

#include "safety/curve_piece.h"
#include "trajectory/motion.h"

namespace mocha {

/// One polynomial piece of a drive, its times absolute.
struct DrivePiece : CurvePiece<2, 5> {
  int drive_direction;  ///< +1 or -1
  /// Has the direction of the velocity, also at the rests where the drive begins or ends: there the
  /// velocity's zeros are divided out. Constant in a piece that moves less than a micrometre there.
  Bernstein<2, 4> course;
};

/// The pieces of the motion's drives from `from_s` (absolute) on; a piece under way at `from_s` is
/// cut there. `phase` is the index of a drive.
std::vector<DrivePiece> drive_pieces(const Motion& motion, int phase, double from_s);

}  // namespace mocha
