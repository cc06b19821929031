#include "base/command_watchdog.h"

#include <cmath>

namespace mocha {
namespace {

constexpr double kTimeSlack_s = 1e-9;  // sums of steps are not exact

}  // namespace

bool CommandWatchdog::take(double now_s, const UnicycleState& command) {
  if (!std::isfinite(command.speed) || !std::isfinite(command.yaw_rate)) {
    ++refused_;
    return false;
  }
  command_ = command;
  taken_s_ = now_s;
  return true;
}

std::optional<UnicycleState> CommandWatchdog::command(double now_s) const {
  const double age_s = now_s - taken_s_;
  if (age_s < 0.0 || age_s > max_age_s_ + kTimeSlack_s) return std::nullopt;
  return command_;
}

}  // namespace mocha
