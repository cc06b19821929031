#include "planning/executive/driven_trail.h"

namespace mocha {
namespace {

constexpr double kSpacing_m = 0.1;
constexpr std::size_t kMostPoints = 200;

}  // namespace

void DrivenTrail::add(const RobotState& state) {
  const Vector2& here = state.pose.position;
  if (state.twist.speed < 0.0) {
    while (!points_.empty() && (points_.back() - here).norm() < 1.5 * kSpacing_m)
      points_.pop_back();
    return;
  }
  if (!points_.empty() && (points_.back() - here).norm() < kSpacing_m) return;
  points_.push_back(here);
  if (points_.size() > kMostPoints) points_.erase(points_.begin());
}

}  // namespace mocha
