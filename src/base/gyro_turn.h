#pragma once

#include <optional>

namespace mocha {

/// How far a base turns, by a gyroscope. Wheels that skid tell it poorly, a gyroscope well, but for
/// its bias: that is learnt whenever the wheels stand.
class GyroTurn {
 public:
  /// The angle turned in the last `dt_s`, at the end of which `yaw_rate` [rad/s] was read: 0 while
  /// the wheels stand; nothing before the bias is known.
  std::optional<double> add(double dt_s, double yaw_rate, bool wheels_stand);

  /// What is left of a reading without the bias [rad/s]; nothing before that is known.
  std::optional<double> unbiased(double yaw_rate) const;

 private:
  void learn(double dt_s, double yaw_rate);

  double stood_s_ = 0.0;   // since the wheels last rolled
  double learnt_s_ = 0.0;  // for how long the bias has been averaged
  double bias_ = 0.0;
  double before_ = 0.0;  // the last reading
};

}  // namespace mocha
