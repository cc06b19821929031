#pragma once

#include <vector>

#include "world/obstacle.h"

namespace mocha {

/// What stands: obstacles, and the edge of the ground, beyond which nothing is known.
struct StaticGround {
  Vector2 low;  ///< corners of the ground
  Vector2 high;
  std::vector<Obstacle> obstacles;
};

/// Tells where a disc has room on such ground: distances on a grid, exact where it matters.
class StaticClearance {
 public:
  /// For a disc of `keep_m`, in cells of `cell_m`.
  StaticClearance(StaticGround ground, double keep_m, double cell_m);

  bool clear(const Vector2& place) const;

 private:
  double distance_m(const Vector2& place) const;

  StaticGround ground_;
  double keep_m_;
  double cell_m_;
  int columns_;
  int rows_;
  std::vector<double> distances_m_;
};

}  // namespace mocha
