#include "simulation/base_emulator.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "simulation/time_slack.h"

namespace mocha {
namespace {

using Json = nlohmann::json;

constexpr double kMostWheelSpeed = 2.0;  // [m/s]
constexpr std::size_t kLongestLine = 4096;
constexpr double kAccelerometer = 8192.0 / 9.80665;     // counts per m/s^2, range of 4 g
constexpr double kGyroBias = 0.012;                     // [rad/s]
constexpr double kGyroNoise = 0.004;                    // [rad/s]
constexpr double kGyro = 16.4 * 180.0 / 3.14159265359;  // counts per rad/s, range of 2000 deg/s
constexpr int kBattery_cv = 1185;                       // [V / 100]
constexpr double kTracks_m[] = {0.125, 0.172, 0.141};   // RaspRover, UGV Rover, UGV Beast

/// Zero for what is not there or no number, as the firmware's JSON library has it.
double number(const Json& command, const char* key) {
  const auto field = command.find(key);
  return field != command.end() && field->is_number() ? field->get<double>() : 0.0;
}

int counts(double value) {
  return static_cast<int>(std::lround(std::clamp(value, -32768.0, 32767.0)));
}

std::int64_t centimetres(double metres) { return static_cast<std::int64_t>(100.0 * metres); }

}  // namespace

BaseEmulator::BaseEmulator(double now_s, const Options& options)
    : options_(options),
      feedback_s_(now_s),
      commanded_s_(now_s),
      left_(options.left),
      right_(options.right) {}

void BaseEmulator::restart(double now_s) { *this = BaseEmulator(now_s, options_); }

void BaseEmulator::receive(double now_s, std::string_view bytes) {
  for (const char byte : bytes) {
    if (byte != '\n') {
      if (partial_.size() < kLongestLine) partial_.push_back(byte);
      continue;
    }
    obey(now_s, partial_);
    partial_.clear();
  }
}

void BaseEmulator::obey(double now_s, const std::string& line) {
  const Json command = Json::parse(line, nullptr, false);
  if (!command.is_object()) return;
  if (echo_) output_ += line + "\n";
  switch (static_cast<int>(std::clamp(number(command, "T"), -1e6, 1e6))) {
    case 0:
      order_ = {};
      stopped_ = options_.holds_stop;
      break;
    case 1:
      obey_drive(now_s, command);
      break;
    case 11:
      obey_pwm(now_s, command);
      break;
    case 13:
      obey_velocity(command);
      break;
    case 131:
      feedback_on_ = number(command, "cmd") != 0.0;
      break;
    case 136:
      heartbeat_s_ = 1e-3 * number(command, "cmd");
      break;
    case 142:
      feedback_interval_s_ = 1e-3 * std::abs(number(command, "cmd"));
      break;
    case 143:
      echo_ = number(command, "cmd") != 0.0;
      break;
    case 900: {
      const double type = number(command, "main");
      if (type == 1.0 || type == 2.0 || type == 3.0)
        track_m_ = kTracks_m[static_cast<int>(type) - 1];
      break;
    }
    case 999:
      stopped_ = false;
      break;
    default:
      break;
  }
}

void BaseEmulator::obey_drive(double now_s, const Json& command) {
  const auto is_number = [&](const char* key) {
    return command.contains(key) && command[key].is_number();
  };
  if (!is_number("L") || !is_number("R")) return;
  heartbeat_fired_ = false;
  commanded_s_ = now_s;
  turn_wheels({number(command, "L"), number(command, "R")});
}

void BaseEmulator::obey_velocity(const Json& command) {
  turn_wheels(wheel_speeds({number(command, "X"), number(command, "Z")}, track_m_));
}

/// Zero for what is not there, unlike T 1.
void BaseEmulator::obey_pwm(double now_s, const Json& command) {
  heartbeat_fired_ = false;
  commanded_s_ = now_s;
  const auto pwm = [&](const char* key) {
    return std::clamp(std::round(number(command, key)), -kMostPwm, kMostPwm);
  };
  if (!stopped_) order_ = {{pwm("L"), pwm("R")}, true};
}

void BaseEmulator::turn_wheels(const WheelSpeeds& speeds) {
  const double fastest = std::max(std::abs(speeds.left), std::abs(speeds.right));
  if (!stopped_ && fastest <= kMostWheelSpeed) order_ = {speeds, false};
}

WheelOrder BaseEmulator::order(double now_s) {
  if (!heartbeat_fired_ && now_s - commanded_s_ > heartbeat_s_ + kTimeSlack_s) {
    heartbeat_fired_ = true;
    order_ = {};
  }
  return order_;
}

WheelSpeeds BaseEmulator::wheels(double now_s) {
  const auto [wheels, by_pwm] = order(now_s);
  if (by_pwm) return {left_.follow_pwm(wheels.left), right_.follow_pwm(wheels.right)};
  return {left_.follow_speed(now_s, wheels.left), right_.follow_speed(now_s, wheels.right)};
}

void BaseEmulator::roll(double left_m, double right_m, const WheelSpeeds& speeds) {
  left_m_ += left_m;
  right_m_ += right_m;
  speeds_ = speeds;
  left_.roll(left_m, speeds.left);
  right_.roll(right_m, speeds.right);
}

void BaseEmulator::feel(double acceleration, double yaw_rate) {
  acceleration_ = acceleration;
  yaw_rate_ = yaw_rate;
}

std::string BaseEmulator::send(double now_s) {
  std::string text;
  text.swap(output_);
  if (feedback_on_ && now_s - feedback_s_ >= feedback_interval_s_ - kTimeSlack_s) {
    feedback_s_ = now_s;
    text += feedback();
  }
  return text;
}

int BaseEmulator::gyro_counts(double rate) {
  std::normal_distribution<double> noise(0.0, kGyroNoise);
  return counts(kGyro * (rate + kGyroBias + noise(random_)));
}

std::string BaseEmulator::feedback() {
  const nlohmann::ordered_json line = {
      {"T", 1001},
      {"L", left_.measured_speed()},
      {"R", right_.measured_speed()},
      {"ax", counts(kAccelerometer * acceleration_)},
      {"ay", counts(kAccelerometer * 0.5 * (speeds_.left + speeds_.right) * yaw_rate_)},
      {"az", counts(kAccelerometer * 9.80665)},
      {"gx", gyro_counts(0.0)},
      {"gy", gyro_counts(0.0)},
      {"gz", gyro_counts(yaw_rate_)},
      {"mx", 0},
      {"my", 0},
      {"mz", 0},
      {"odl", centimetres(left_m_)},
      {"odr", centimetres(right_m_)},
      {"v", kBattery_cv}};
  return line.dump() + "\r\n";
}

}  // namespace mocha
