#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/line_buffer.h"
#include "trajectory/unicycle.h"

namespace mocha {

/// The serial protocol of the Waveshare UGV family (RaspRover, UGV Rover, UGV Beast): lines of
/// JSON, whose "T" is the kind. Nothing but bytes here.
///
/// Driven is with T 1 (wheel speeds) or T 11 (PWM) alone: the firmware's heartbeat, which stops the
/// wheels when the computer dies, counts from the last of these. T 13 (body velocities) is not
/// under its watch.

/// What the firmware does not do of itself, or forgets when it restarts.
struct WaveshareOptions {
  int robot_type;            ///< 1 RaspRover, 2 UGV Rover, 3 UGV Beast: their wheels and encoders
  int heartbeat_ms;          ///< the wheels stop so long after the last command
  int feedback_interval_ms;  ///< between two lines of feedback
};

/// The firmware ignores commands beyond this and goes on with the former one, heartbeat refreshed.
constexpr double kWaveshareMaxWheelSpeed = 2.0;  // [m/s]

constexpr double kWaveshareMaxPwm = 255.0;

/// The lines that bring the firmware to `firmware`.
std::vector<std::string> waveshare_setup(const WaveshareOptions& firmware);

/// Wheel rim speeds [m/s]. Where one is beyond the firmware's limit both are slowed down, which
/// keeps the curvature; what is not finite stands.
std::string waveshare_drive(const WheelSpeeds& wheels);

/// PWM of 255 for the motors of both sides, which the firmware then does not control; what is not
/// finite stands.
std::string waveshare_pwm(double left, double right);

std::string waveshare_emergency_stop();
std::string waveshare_emergency_reset();

/// One line T 1001.
struct WaveshareFeedback {
  /// Counts of the sensor (16 bits), whose scale the firmware does not tell.
  struct Imu {
    std::array<double, 3> acceleration;
    std::array<double, 3> rate;
  };

  WheelSpeeds speeds = {0.0, 0.0};  ///< [m/s] of the moment, in whole pulses
  std::int64_t left_cm = 0;         ///< travelled since the base was switched on, cut towards zero
  std::int64_t right_cm = 0;
  double battery_v = 0.0;
  std::optional<Imu> imu;
};

/// Turns what comes from the firmware into feedback. Whatever is not, is refused and counted.
class WaveshareDecoder {
 public:
  struct Counts {
    long feedback = 0;
    long other = 0;        ///< JSON of another kind: echoes of commands
    long garbage = 0;      ///< no JSON: half lines, noise, the firmware's chatter when it starts
    long implausible = 0;  ///< feedback with a field missing, of the wrong type or out of range
    long overlong = 0;

    long refused() const { return garbage + implausible + overlong; }
  };

  std::vector<WaveshareFeedback> take(std::string_view bytes);

  /// A new connection begins: what came of a line last is garbage.
  void restart();

  Counts counts() const;
  /// Why the last line was refused, and its beginning.
  const std::string& last_refusal() const { return last_refusal_; }

 private:
  std::optional<WaveshareFeedback> decode(const std::string& line);

  LineBuffer lines_{1024};  // a line of feedback has about 150 characters
  Counts counts_;
  std::string last_refusal_;
};

}  // namespace mocha
