#pragma once

namespace mocha {

/// The firmware's full output, of both signs.
constexpr double kMostPwm = 255.0;

/// One side of a Waveshare UGV Rover: its encoder, the firmware's speed control, motor and gearbox.
/// It says what the rim heads for; the inertia on the way there is the vehicle's.
///
/// What the firmware does (ugv_base_ros of 2024 and 2025, read; its log in issue 10 agrees):
/// - The speed is measured anew in every turn of its main loop, of 1 ms: whole pulses, of which a
///   turn of the wheel of 0.08 m has 660. So it reads as a multiple of 0.38 m/s, and at 0.1 m/s
///   mostly as 0.
/// - A PI control with 20 and 2000 (PWM of 255 per m/s, and per m) looks at one such reading every
///   100 ms, its library's period. A single pulse moves its sum by 76, a good deal of which is
///   friction.
/// - Its sum winds up to 255 before it is cut, outlives standstill, and is not cleared by a stop.
/// - An output below 23 is none. Told to stand, a wheel that reads 0 gets none either, so that it
///   brakes through most of the loop.
///
/// That is how it cogs: the wheel stands until the sum overcomes its friction, leaps, is seen to
/// be too fast by a pulse, and stands again. An order by PWM (T 11) passes all this by.
///
/// What a motor does is an estimate: its speed is proportional to what friction leaves of the PWM,
/// 1.3 m/s (the vendor's top speed) at all of it; to set off it needs more than to keep rolling.
class WheelDrive {
 public:
  struct Options {
    double breakaway_pwm = 45.0;  ///< of 255: a standing wheel sets off beyond this
    double friction_pwm = 35.0;   ///< of 255: taken from what drives a rolling wheel
  };

  explicit WheelDrive(const Options& options) : options_(options) {}

  /// What the encoder saw: rolled [m], and the true speed at the end.
  void roll(double rolled_m, double speed);

  /// The speed as the firmware reads it [m/s].
  double measured_speed() const;

  /// What the rim heads for [m/s] where the firmware is told a speed, or a PWM.
  double follow_speed(double now_s, double wanted);
  double follow_pwm(double pwm) const;

 private:
  void control(double wanted);

  Options options_;
  double rolled_m_ = 0.0;
  double speed_ = 0.0;
  double controlled_s_ = 0.0;  // when the control looked last
  double sum_ = 0.0;
  double output_ = 0.0;
};

}  // namespace mocha
