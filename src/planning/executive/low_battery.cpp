#include "planning/executive/low_battery.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace mocha {
namespace {

constexpr double kRetry_s = 30.0;

/// "[x, y]" or "[x, y, yaw]"; nothing for an empty text.
std::optional<Goal> read_goal(const std::string& text) {
  if (text.empty()) return std::nullopt;
  std::vector<double> values;
  try {
    values = YAML::Load(text).as<std::vector<double>>();
  } catch (const YAML::Exception&) {
  }
  const bool finite =
      std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  if (!finite || values.size() < 2 || values.size() > 3) {
    throw ParameterError("low_battery_goal = " + text +
                         ", expected \"[x, y]\" or \"[x, y, yaw]\", or nothing");
  }
  Goal goal{{values[0], values[1]}, std::nullopt};
  if (values.size() == 3) goal.yaw_rad = values[2];
  return goal;
}

}  // namespace

LowBattery::Options LowBattery::Options::from(const ParameterTable& values, double low_v) {
  const Options options{read_goal(values.text("low_battery_goal")), low_v,
                        values.number("charged_battery"), values.number("low_battery_delay")};
  if (!options.goal || options.charged_v > low_v) return options;
  throw ParameterError("charged_battery = " + std::to_string(options.charged_v) +
                       " V, expected more than low_battery of base_driver, " +
                       std::to_string(low_v) + " V");
}

void LowBattery::hear(double now_s, double voltage) {
  if (!options_.goal || !std::isfinite(voltage)) return;
  voltage_ = voltage;
  const bool other_side = low_ ? voltage >= options_.charged_v : voltage < options_.low_v;
  if (!other_side) {
    since_s_.reset();
    return;
  }
  if (!since_s_ || now_s < *since_s_) since_s_ = now_s;
  if (now_s - *since_s_ < options_.delay_s) return;
  low_ = !low_;
  since_s_.reset();
}

LowBattery::News LowBattery::step(double now_s, bool idle, bool stopped) {
  if (low_ != told_) {
    told_ = low_;
    arrived_ = false;
    stays_ = false;
    sent_s_.reset();
    return low_ ? News::kLow : News::kCharged;
  }
  if (!low_) return News::kNone;
  if (stopped) stays_ = true;
  const bool due = !sent_s_ || now_s - *sent_s_ >= kRetry_s || now_s < *sent_s_;
  if (stays_ || arrived_ || !idle || !due) return News::kNone;
  sent_s_ = now_s;
  return News::kGo;
}

std::string LowBattery::reason() const {
  if (!low_) return "";
  char text[120];
  std::snprintf(text, sizeof(text), "battery low: %.2f V; goals are taken again from %.2f V on",
                voltage_, options_.charged_v);
  return text;
}

}  // namespace mocha
