#pragma once

#include "base/wheel_travel.h"
#include "config/parameter_table.h"
#include "world/robot_model.h"

namespace mocha {

/// The speed control of one wheel by the PWM of its motor.
///
/// The firmware's own goes by a speed of one or no pulse of the encoder: a wheel stalls and leaps
/// where it is told less than about 0.2 m/s. This one says beforehand what PWM a speed takes, and
/// corrects that slowly by the one good witness there is, the distance rolled: where the wheel is
/// behind what it was told, or ahead.
///
/// A wheel that stands takes more to set off. It gets that until it is seen to roll, and again
/// where it stalls. What is slower than a wheel can roll steadily is done in small steps, each as
/// the distance for it has come together: what feedback asks to and fro does not move it.
class WheelControl {
 public:
  struct Options {
    double pwm_per_speed;  ///< of 255 [s/m], on top of friction
    double friction_pwm;   ///< of 255: keeps a wheel rolling
    double breakaway_pwm;  ///< of 255: sets a standing wheel off
    double lag_s;          ///< from the PWM until its speed is there, and measured

    /// From the parameters of base_driver and the model's lag.
    static Options from(const ParameterTable& values, const RobotModel& model);
  };

  explicit WheelControl(const Options& options) : options_(options) {}

  /// What was measured since the last call.
  void measure(const WheelTravel::Step& step);

  /// The PWM of 255 for a wheel that was told so, or to stand, for the last `dt_s` and is `wanted`
  /// to turn so from now on [m/s].
  double pwm(double dt_s, double wanted);

 private:
  Options options_;
  double wanted_ = 0.0;
  double expected_ = 0.0;  // speed [m/s], from what was wanted
  double behind_m_ = 0.0;
  bool steps_ = false;    // rolls, where it is told to creep
  double still_s_ = 1e9;  // since it was seen to roll
};

}  // namespace mocha
