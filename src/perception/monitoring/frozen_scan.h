#pragma once

#include <vector>

#include "trajectory/motion.h"

namespace mocha {

/// Notices a lidar that repeats itself: the same ranges though the robot has moved on. A robot that
/// stands sees the same again where its lidar has no noise.
class FrozenScan {
 public:
  /// Takes the next scan, and the robot's pose at its time in any frame that does not jump.
  void add(const std::vector<float>& ranges_m, const Pose& pose);

  /// How often in a row the newest scan was repeated.
  int repeats() const { return repeats_; }
  /// How far the robot has moved meanwhile [m], a radian of turning counting as 0.5 m.
  double moved_m() const { return moved_m_; }

  void clear() { *this = FrozenScan(); }

 private:
  std::vector<float> ranges_m_;
  Pose pose_;
  int repeats_ = 0;
  double moved_m_ = 0.0;
};

}  // namespace mocha
