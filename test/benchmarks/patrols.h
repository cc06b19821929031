#pragma once

#include <vector>

#include "world/obstacle.h"

namespace mocha {

/// Robots that go round the places of their patrols, one each, and swap patrols. No place belongs
/// to two patrols, so no two robots ever go to one place.
class Patrols {
 public:
  /// Robot i begins with patrol i, at its first place and on its way to the next one. Each has at
  /// least two.
  explicit Patrols(std::vector<std::vector<Vector2>> places);

  /// Where a robot is to go.
  const Vector2& next(int robot) const { return places_[of_[robot]][next_[of_[robot]]]; }
  /// The robot is there.
  void arrive(int robot);
  /// Each takes over where the one after it was going.
  void swap();

 private:
  std::vector<std::vector<Vector2>> places_;
  std::vector<int> of_;    // the patrol of each robot
  std::vector<int> next_;  // the place of each patrol
};

}  // namespace mocha
