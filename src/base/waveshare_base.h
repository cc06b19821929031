#pragma once

#include <optional>
#include <string>

#include "base/base_interface.h"
#include "base/serial_port.h"
#include "base/waveshare_protocol.h"
#include "base/wheel_control.h"
#include "base/wheel_odometry.h"
#include "config/parameter_table.h"
#include "world/robot_model.h"

namespace mocha {

/// A robot of the Waveshare UGV family on a serial line.
///
/// Its settings, the heartbeat first of all, are sent when a connection begins and once a second
/// after: a base that restarted meanwhile (a weak battery, its reset button) has forgotten them and
/// would go on for 3 s without commands. Its firmware does not hold an emergency stop, whatever it
/// says: it is held here. Its speed control is not fit for low speeds: unless told otherwise, it is
/// done here.
class WaveshareBase : public BaseInterface {
 public:
  struct Options {
    std::string device;
    int baud;
    WaveshareOptions firmware;
    WheelOdometry::Options odometry;
    std::optional<WheelControl::Options> wheel_control;  ///< nothing: the firmware's own
    double feedback_timeout_s;  ///< without feedback so long, the base is not driven
    double feedback_delay_s;    ///< from the reading of its sensors to its arrival here
    double acceleration_scale;  ///< [m/s^2] per count of the sensor
    double gyro_scale;          ///< [rad/s] per count
    bool use_gyro;              ///< for the heading
    double wheel_speed_noise;   ///< [m/s] standard deviation of a wheel's speed, smoothed

    /// From the parameters of base_driver; the wheels are those of the model.
    static Options from(const ParameterTable& values, const RobotModel& model);
  };

  explicit WaveshareBase(const Options& options);

  std::vector<BaseFeedback> poll(double now_s) override;
  bool connected(double now_s) const override;
  void drive(const UnicycleState& command) override;
  void set_emergency_stop(bool stopped) override;
  std::string fault(double now_s) const override;
  std::vector<std::pair<std::string, std::string>> details() const override;

 private:
  void send(const std::string& line);
  void send_setup(double now_s);
  void send_stop();
  std::optional<double> gyro_yaw_rate(const WaveshareFeedback& line) const;
  std::string drive_line(const WheelSpeeds& wheels);
  BaseFeedback feedback(double stamp_s, const WaveshareFeedback& line);

  Options options_;
  SerialPort port_;
  WaveshareDecoder decoder_;
  WheelOdometry odometry_;
  std::optional<WheelControl> left_;
  std::optional<WheelControl> right_;
  WheelSpeeds told_ = {0.0, 0.0};
  double now_s_ = 0.0;        // of the last poll()
  double driven_s_ = 0.0;     // when the wheels were told last
  std::optional<bool> stop_;  // what was asked for last: an emergency stop, or its end
  double opened_s_ = 0.0;
  double setup_s_ = 0.0;  // when the settings were sent last
  double heard_s_;        // when feedback came last
  double stamp_s_;        // of the newest feedback
  long unsent_ = 0;
};

}  // namespace mocha
