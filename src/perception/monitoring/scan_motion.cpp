#include "perception/monitoring/scan_motion.h"

#include <cmath>

#include "trajectory/frame_change.h"

namespace mocha {
namespace {

// So far from its reference a scan becomes the next one.
constexpr double kFar_m = 0.4;
constexpr double kFar_rad = 0.4;
constexpr double kFewInliers = 0.75;

}  // namespace

void ScanMotion::begin(const ScanHits& scan) {
  reference_.emplace(scan);
  newest_ = Pose{};
}

std::optional<ScanAlignment> ScanMotion::best(const ScanHits& scan, const Pose& odometry) const {
  std::optional<ScanAlignment> best;
  for (const Pose& step : {relative(odometry_, odometry), step_}) {
    const auto found = reference_->align(scan, composed(newest_, step));
    if (found && (!best || found->inliers > best->inliers)) best = found;
  }
  return best;
}

std::optional<Pose> ScanMotion::add(const ScanHits& scan, const Pose& odometry) {
  const auto found = reference_ ? best(scan, odometry) : std::nullopt;
  odometry_ = odometry;
  if (!found) {
    step_ = Pose{};
    begin(scan);
    return std::nullopt;
  }
  step_ = relative(newest_, found->pose);
  newest_ = found->pose;
  if (newest_.position.norm() > kFar_m || std::abs(newest_.yaw_rad) > kFar_rad ||
      found->inliers < kFewInliers)
    begin(scan);
  return step_;
}

}  // namespace mocha
