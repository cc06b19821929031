#pragma once

#include <optional>
#include <string>

#include "trajectory/motion.h"
#include "trajectory/unicycle.h"

namespace mocha {

/// Notices an odometry that stands to the last digit while the wheels are commanded to turn: it is
/// frozen, or the wheels are blocked. Either way the robot is not to be driven by it.
class OdometryCheck {
 public:
  /// `max_travel_m`: so much may be commanded meanwhile, a radian counting as 0.5 m. For `hold_s`
  /// after that it is not believed.
  OdometryCheck(double max_travel_m, double hold_s)
      : max_travel_m_(max_travel_m), hold_s_(hold_s) {}

  /// Takes the pose in the odometry's own frame at a time, and the command since the last call. The
  /// same time again says nothing new.
  void add(double time_s, const Pose& odometry, const UnicycleState& command);

  bool is_frozen(double time_s) const { return frozen_until_s_ && time_s < *frozen_until_s_; }
  /// Why it is not believed, for people.
  std::string words() const;

 private:
  double max_travel_m_;
  double hold_s_;
  std::optional<double> time_s_;
  Pose odometry_;
  double travel_m_ = 0.0;
  std::optional<double> frozen_until_s_;
};

}  // namespace mocha
