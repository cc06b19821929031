#pragma once

#include <nlohmann/json_fwd.hpp>
#include <random>
#include <string>
#include <string_view>

#include "simulation/wheel_drive.h"
#include "trajectory/unicycle.h"

namespace mocha {

/// What the wheels of a base are told: speeds [m/s], or a PWM of 255, which nothing controls.
struct WheelOrder {
  WheelSpeeds wheels = {0.0, 0.0};
  bool by_pwm = false;
};

/// A Waveshare UGV, as its computer sees it through the serial line: bytes in, bytes out, and
/// between them the speeds that its wheels head for.
///
/// Its faults are kept, as a driver has to live with them:
/// - Its speed control cogs and stalls at low speed, and the speeds that it reports are as coarse
///   as what it controls by: see WheelDrive.
/// - T 1 with a wheel beyond +-2 m/s is ignored, but refreshes the heartbeat: the old speeds go on.
/// - Without T 1 for the heartbeat (T 136, 3000 ms at the start) the wheels are stopped, once: what
///   T 13 commands after that is never stopped.
/// - T 13 does not refresh the heartbeat. T 11 (PWM) does, and is under its watch.
/// - Odometers count whole centimetres, cut towards zero, and begin again at every start.
///
/// Its gyroscope has a bias and noise, as such sensors have.
///
/// Commands are echoed until T 143 says otherwise. What is no JSON is ignored without a word.
/// Firmware of 2024 and later does not hold an emergency stop (T 0) until its reset (T 999);
/// `holds_stop` says whether this one does.
class BaseEmulator {
 public:
  struct Options {
    bool holds_stop = true;
    WheelDrive::Options left;
    WheelDrive::Options right;
  };

  explicit BaseEmulator(double now_s) : BaseEmulator(now_s, Options()) {}
  BaseEmulator(double now_s, const Options& options);

  /// What the computer sent. Half a line waits for its rest.
  void receive(double now_s, std::string_view bytes);

  /// What the wheels are told now, the heartbeat looked after.
  WheelOrder order(double now_s);

  /// What their rims head for [m/s] because of that; ask every 0.1 s at least.
  WheelSpeeds wheels(double now_s);

  /// What the encoders saw of the last step: rolled [m], and the speeds at its end.
  void roll(double left_m, double right_m, const WheelSpeeds& speeds);

  /// What the IMU feels now: acceleration along the heading [m/s^2], yaw rate [rad/s].
  void feel(double acceleration, double yaw_rate);

  /// What it has to say: chatter of its start, echoes, and feedback where it is due.
  std::string send(double now_s);

  /// Switched off and on again: settings and odometers are as they come.
  void restart(double now_s);

  bool stopped() const { return stopped_; }

 private:
  void obey(double now_s, const std::string& line);
  void obey_drive(double now_s, const nlohmann::json& command);
  void obey_velocity(const nlohmann::json& command);
  void obey_pwm(double now_s, const nlohmann::json& command);
  void turn_wheels(const WheelSpeeds& speeds);
  std::string feedback();
  int gyro_counts(double rate);

  Options options_;
  std::string partial_;
  std::string output_ = "UGV started.\r\n";
  bool echo_ = true;
  bool feedback_on_ = true;
  double feedback_interval_s_ = 0.05;
  double feedback_s_;  // when the last was sent
  double heartbeat_s_ = 3.0;
  double commanded_s_;  // the last T 1 or T 11
  bool heartbeat_fired_ = false;
  bool stopped_ = false;
  double track_m_ = 0.172;
  WheelOrder order_;
  WheelDrive left_;
  WheelDrive right_;
  WheelSpeeds speeds_ = {0.0, 0.0};  // as they are
  double left_m_ = 0.0;
  double right_m_ = 0.0;
  double acceleration_ = 0.0;
  double yaw_rate_ = 0.0;
  std::mt19937 random_{1};
};

}  // namespace mocha
