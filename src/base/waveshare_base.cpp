#include "base/waveshare_base.h"

#include <algorithm>
#include <cstdio>
#include <limits>

namespace mocha {
namespace {

constexpr double kSetupPeriod_s = 1.0;
constexpr double kLongestStep_s = 0.1;
constexpr double kGyroSigma = 0.02;  // [rad/s] of one reading
constexpr double kNever = -std::numeric_limits<double>::infinity();

}  // namespace

WaveshareBase::Options WaveshareBase::Options::from(const ParameterTable& values,
                                                    const RobotModel& model) {
  Options options;
  options.device = values.text("port");
  options.baud = values.integer("baud");
  options.firmware = {values.integer("robot_type"), values.integer("heartbeat"),
                      values.integer("feedback_interval")};
  options.odometry = {model.limits.track_m, model.limits.max_wheel_speed,
                      model.odometry_noise_distance, model.odometry_noise_yaw,
                      values.number("gyro_noise")};
  if (values.text("speed_control") == "driver")
    options.wheel_control = WheelControl::Options::from(values, model);
  options.feedback_timeout_s = values.number("feedback_timeout");
  options.feedback_delay_s = values.number("feedback_delay");
  options.acceleration_scale = values.number("acceleration_scale");
  options.gyro_scale = values.number("gyro_scale");
  options.use_gyro = values.flag("use_gyro");
  options.wheel_speed_noise = values.number("wheel_speed_noise");
  return options;
}

WaveshareBase::WaveshareBase(const Options& options)
    : options_(options),
      port_(options.device, options.baud),
      odometry_(options.odometry),
      left_(options.wheel_control),
      right_(options.wheel_control),
      heard_s_(kNever),
      stamp_s_(kNever) {}

std::vector<BaseFeedback> WaveshareBase::poll(double now_s) {
  now_s_ = now_s;
  if (port_.poll(now_s)) {
    opened_s_ = now_s;
    decoder_.restart();
    send("\n");  // ends half a line that another program may have left
    send_setup(now_s);
  }
  const bool set_back = now_s < setup_s_;
  if (now_s - setup_s_ >= kSetupPeriod_s || set_back) send_setup(now_s);

  const std::vector<WaveshareFeedback> lines = decoder_.take(port_.read());
  std::vector<BaseFeedback> result;
  // Of several that waited here, the former ones are older.
  double age_s = 1e-3 * options_.firmware.feedback_interval_ms * static_cast<double>(lines.size());
  for (const WaveshareFeedback& line : lines) {
    age_s -= 1e-3 * options_.firmware.feedback_interval_ms;
    const double stamp_s = now_s - options_.feedback_delay_s - age_s;
    stamp_s_ = set_back ? stamp_s : std::max(stamp_s, stamp_s_);
    result.push_back(feedback(stamp_s_, line));
    heard_s_ = now_s;
  }
  return result;
}

/// Nothing without a gyroscope: where it is missing or broken, the firmware sends zeros.
std::optional<double> WaveshareBase::gyro_yaw_rate(const WaveshareFeedback& line) const {
  if (!options_.use_gyro || !line.imu) return std::nullopt;
  const auto& rates = line.imu->rate;
  if (std::all_of(rates.begin(), rates.end(), [](double rate) { return rate == 0.0; }))
    return std::nullopt;
  return options_.gyro_scale * rates[2];
}

BaseFeedback WaveshareBase::feedback(double stamp_s, const WaveshareFeedback& line) {
  const std::optional<double> yaw_rate = gyro_yaw_rate(line);
  const bool driven = told_.left != 0.0 || told_.right != 0.0;
  odometry_.add(stamp_s, {line.speeds, line.left_cm, line.right_cm, yaw_rate, driven});
  if (left_) left_->measure(odometry_.left().last());
  if (right_) right_->measure(odometry_.right().last());
  const double track = options_.odometry.track_m;
  const double variance = options_.wheel_speed_noise * options_.wheel_speed_noise;
  BaseFeedback result;
  result.stamp_s = stamp_s;
  result.pose = odometry_.pose();
  result.pose_covariance = odometry_.covariance();
  result.twist = from_wheel_speeds({odometry_.left().speed(), odometry_.right().speed()}, track);
  result.speed_variance = 0.5 * variance;
  result.yaw_rate_variance = 2.0 * variance / (track * track);
  if (const auto turning = odometry_.gyro_yaw_rate()) {
    result.twist.yaw_rate = *turning;
    result.yaw_rate_variance = kGyroSigma * kGyroSigma;
  }
  result.battery_v = line.battery_v;
  if (line.imu) {
    const auto& [a, r] = *line.imu;
    result.imu = ImuReading{options_.acceleration_scale * Eigen::Vector3d(a[0], a[1], a[2]),
                            options_.gyro_scale * Eigen::Vector3d(r[0], r[1], r[2])};
  }
  return result;
}

bool WaveshareBase::connected(double now_s) const {
  const double silent_s = now_s - heard_s_;
  return port_.is_open() && silent_s >= 0.0 && silent_s <= options_.feedback_timeout_s;
}

void WaveshareBase::drive(const UnicycleState& command) {
  const UnicycleState wanted = stop_.value_or(false) ? UnicycleState{0.0, 0.0} : command;
  if (port_.is_open()) send(drive_line(wheel_speeds(wanted, options_.odometry.track_m)));
}

std::string WaveshareBase::drive_line(const WheelSpeeds& wheels) {
  told_ = wheels;
  const double dt_s = std::clamp(now_s_ - driven_s_, 0.0, kLongestStep_s);
  driven_s_ = now_s_;
  if (!left_ || !right_) return waveshare_drive(wheels);
  return waveshare_pwm(left_->pwm(dt_s, wheels.left), right_->pwm(dt_s, wheels.right));
}

void WaveshareBase::set_emergency_stop(bool stopped) {
  stop_ = stopped;
  send_stop();
}

void WaveshareBase::send_setup(double now_s) {
  setup_s_ = now_s;
  if (!port_.is_open()) return;
  for (const std::string& line : waveshare_setup(options_.firmware)) send(line);
  send_stop();
}

void WaveshareBase::send_stop() {
  if (!stop_ || !port_.is_open()) return;
  send(*stop_ ? waveshare_emergency_stop() : waveshare_emergency_reset());
  if (*stop_) drive({0.0, 0.0});
}

void WaveshareBase::send(const std::string& line) {
  if (!port_.write(line)) ++unsent_;
}

std::string WaveshareBase::fault(double now_s) const {
  if (!port_.is_open()) return port_.fault();
  if (connected(now_s)) return "";
  char text[64];
  std::snprintf(text, sizeof(text), ": no feedback for %.1f s",
                now_s - std::max(heard_s_, opened_s_));
  return options_.device + text;
}

std::vector<std::pair<std::string, std::string>> WaveshareBase::details() const {
  const WaveshareDecoder::Counts counts = decoder_.counts();
  return {{"device", options_.device},
          {"lines of feedback", std::to_string(counts.feedback)},
          {"lines of other kinds", std::to_string(counts.other)},
          {"lines refused: garbage", std::to_string(counts.garbage)},
          {"lines refused: implausible", std::to_string(counts.implausible)},
          {"lines refused: without end", std::to_string(counts.overlong)},
          {"last refused line", decoder_.last_refusal()},
          {"lines not sent", std::to_string(unsent_)},
          {"port lost", std::to_string(port_.losses())},
          {"base restarted", std::to_string(odometry_.restarts())}};
}

}  // namespace mocha
