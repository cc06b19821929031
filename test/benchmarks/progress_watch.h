#pragma once

#include "world/obstacle.h"

namespace mocha {

/// Tells how long a robot that has a goal neither arrives nor gets anywhere.
class ProgressWatch {
 public:
  static constexpr double kMoved_m = 0.3;  ///< that far from where it was, it gets somewhere

  /// How long it has waited.
  double update(double now_s, const Vector2& place) {
    if ((place - place_).norm() > kMoved_m) restart(now_s, place);
    return now_s - since_s_;
  }
  /// It arrived, or has a goal now and had none.
  void restart(double now_s, const Vector2& place) {
    since_s_ = now_s;
    place_ = place;
  }

 private:
  Vector2 place_ = Vector2::Zero();
  double since_s_ = 0.0;
};

}  // namespace mocha
