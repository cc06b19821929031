#pragma once

#include <vector>

#include "trajectory/motion.h"

namespace mocha {

/// Obstacles on orders that team-mates could not keep to, as they told. They lapse: what stands
/// there may go away, and who is sent there once more tells again.
class ToldObstacles {
 public:
  /// Returns whether one of them is new; those that there is no room for are not heeded.
  bool note(const std::vector<Vector2>& obstacles, double now_s);
  /// Those that have not lapsed.
  std::vector<Vector2> all(double now_s) const;

 private:
  struct Told {
    Vector2 place;
    double time_s;
  };
  std::vector<Told> told_;
};

}  // namespace mocha
