#include "perception/monitoring/frozen_scan.h"

#include <cmath>

#include "trajectory/frame_change.h"

namespace mocha {
namespace {

constexpr int kFewestReturns = 10;  // nothing in sight may stay nothing
constexpr double kSame = 0.99;      // share of the returns
constexpr double kTurnArm_m = 0.5;

bool is_repeated(const std::vector<float>& before, const std::vector<float>& now) {
  if (before.size() != now.size()) return false;
  int returns = 0;
  int same = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (!std::isfinite(now[i]) && !std::isfinite(before[i])) continue;
    ++returns;
    if (now[i] == before[i]) ++same;
  }
  return returns >= kFewestReturns && same >= kSame * returns;
}

}  // namespace

void FrozenScan::add(const std::vector<float>& ranges_m, const Pose& pose) {
  if (is_repeated(ranges_m_, ranges_m)) {
    const Pose step = relative(pose_, pose);
    ++repeats_;
    moved_m_ += step.position.norm() + kTurnArm_m * std::abs(step.yaw_rad);
  } else {
    repeats_ = 0;
    moved_m_ = 0.0;
  }
  ranges_m_ = ranges_m;
  pose_ = pose;
}

}  // namespace mocha
