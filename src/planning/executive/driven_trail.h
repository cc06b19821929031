#pragma once

#include <vector>

#include "control/robot_state.h"

namespace mocha {

/// Where the robot came from, newest last: it grows while the robot drives forward and is taken
/// back while it backs out.
class DrivenTrail {
 public:
  void add(const RobotState& state);
  const std::vector<Vector2>& points() const { return points_; }

 private:
  std::vector<Vector2> points_;
};

}  // namespace mocha
