#include "base/waveshare_protocol.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace mocha {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

// Beyond these, a line was damaged on its way.
constexpr double kMostSpeed = 10.0;       // [m/s]
constexpr double kMostOdometer_cm = 1e9;  // 10,000 km
constexpr double kMostBattery_cv = 1e4;   // [V / 100]
constexpr double kMostCount = 32768.0;    // of a sensor of 16 bits

std::string line(const OrderedJson& command) { return command.dump() + "\n"; }

double number(const Json& message, const char* key, double least, double most) {
  const auto field = message.find(key);
  if (field == message.end()) throw std::invalid_argument(std::string("no `") + key + "`");
  if (!field->is_number()) throw std::invalid_argument(std::string("`") + key + "` is no number");
  const double value = field->get<double>();
  if (!(value >= least && value <= most))
    throw std::invalid_argument(std::string("`") + key + "` = " + field->dump());
  return value;
}

double number(const Json& message, const char* key, double most) {
  return number(message, key, -most, most);
}

std::int64_t centimetres(const Json& message, const char* key) {
  const double value = number(message, key, kMostOdometer_cm);
  if (value != std::trunc(value))
    throw std::invalid_argument(std::string("`") + key + "` is not whole");
  return static_cast<std::int64_t>(value);
}

/// All of it or nothing: firmware of other days sends none.
std::optional<WaveshareFeedback::Imu> imu_of(const Json& message) {
  const auto given = {"ax", "ay", "az", "gx", "gy", "gz"};
  if (std::none_of(given.begin(), given.end(), [&](auto key) { return message.contains(key); }))
    return std::nullopt;
  const auto count = [&](const char* key) { return number(message, key, kMostCount); };
  return WaveshareFeedback::Imu{{count("ax"), count("ay"), count("az")},
                                {count("gx"), count("gy"), count("gz")}};
}

/// Throws std::invalid_argument naming the field at fault.
WaveshareFeedback feedback_of(const Json& message) {
  WaveshareFeedback feedback;
  feedback.speeds = {number(message, "L", kMostSpeed), number(message, "R", kMostSpeed)};
  feedback.left_cm = centimetres(message, "odl");
  feedback.right_cm = centimetres(message, "odr");
  feedback.battery_v = 0.01 * number(message, "v", 0.0, kMostBattery_cv);
  feedback.imu = imu_of(message);
  return feedback;
}

/// The beginning of a line, safe to show.
std::string shown(const std::string& text) {
  constexpr std::size_t kMost = 40;
  std::string beginning = text.substr(0, kMost);
  for (char& c : beginning) {
    if (c < ' ' || c > '~') c = '?';
  }
  return "`" + beginning + (text.size() > kMost ? "...`" : "`");
}

}  // namespace

std::vector<std::string> waveshare_setup(const WaveshareOptions& firmware) {
  return {line({{"T", 136}, {"cmd", firmware.heartbeat_ms}}),  // first: the one that matters
          line({{"T", 143}, {"cmd", 0}}),
          // Module 0: an arm would put its own values where those of the accelerometer are.
          line({{"T", 900}, {"main", firmware.robot_type}, {"module", 0}}),
          line({{"T", 142}, {"cmd", firmware.feedback_interval_ms}}),
          line({{"T", 131}, {"cmd", 1}})};
}

std::string waveshare_drive(const WheelSpeeds& wheels) {
  const double fastest = std::max(std::abs(wheels.left), std::abs(wheels.right));
  if (!std::isfinite(wheels.left) || !std::isfinite(wheels.right))
    return waveshare_drive({0.0, 0.0});
  const double scale = fastest > kWaveshareMaxWheelSpeed ? kWaveshareMaxWheelSpeed / fastest : 1.0;
  const auto rounded = [&](double speed) { return std::round(1e4 * scale * speed) / 1e4; };
  return line({{"T", 1}, {"L", rounded(wheels.left)}, {"R", rounded(wheels.right)}});
}

std::string waveshare_pwm(double left, double right) {
  if (!std::isfinite(left) || !std::isfinite(right)) return waveshare_pwm(0.0, 0.0);
  const auto whole = [](double pwm) {
    return static_cast<int>(std::lround(std::clamp(pwm, -kWaveshareMaxPwm, kWaveshareMaxPwm)));
  };
  return line({{"T", 11}, {"L", whole(left)}, {"R", whole(right)}});
}

std::string waveshare_emergency_stop() { return line({{"T", 0}}); }

std::string waveshare_emergency_reset() { return line({{"T", 999}}); }

std::vector<WaveshareFeedback> WaveshareDecoder::take(std::string_view bytes) {
  std::vector<WaveshareFeedback> feedback;
  const long overlong = lines_.overlong();
  for (const std::string& line : lines_.add(bytes)) {
    if (auto decoded = decode(line)) feedback.push_back(*decoded);
  }
  if (lines_.overlong() > overlong) last_refusal_ = "a line without end";
  return feedback;
}

std::optional<WaveshareFeedback> WaveshareDecoder::decode(const std::string& line) {
  const Json message = Json::parse(line, nullptr, false);
  if (!message.is_object()) {
    ++counts_.garbage;
    last_refusal_ = "no JSON: " + shown(line);
    return std::nullopt;
  }
  const auto kind = message.find("T");
  if (kind == message.end() || *kind != 1001) {
    ++counts_.other;
    return std::nullopt;
  }
  try {
    const WaveshareFeedback feedback = feedback_of(message);
    ++counts_.feedback;
    return feedback;
  } catch (const std::invalid_argument& error) {
    ++counts_.implausible;
    last_refusal_ = std::string(error.what()) + " in " + shown(line);
    return std::nullopt;
  }
}

void WaveshareDecoder::restart() {
  if (!lines_.drop_partial()) return;
  ++counts_.garbage;
  last_refusal_ = "half a line, when the connection ended";
}

WaveshareDecoder::Counts WaveshareDecoder::counts() const {
  Counts counts = counts_;
  counts.overlong = lines_.overlong();
  return counts;
}

}  // namespace mocha
