#pragma once

#include <vector>

#include "trajectory/motion.h"

namespace mocha {

/// The obstacles that team-mates have told of, on orders that they could not keep to. Each lapses
/// after a while, as it may have gone; a robot that is sent there again tells of it anew.
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
