#include "benchmarks/log_drive.h"

#include <algorithm>
#include <cmath>

#include "benchmarks/skid_odometry.h"
#include "trajectory/frame_change.h"

namespace mocha {
namespace {

constexpr double kLeastRange_m = 0.05;
constexpr double kMostRange_m = 30.0;
constexpr double kSpeed = 0.3;    // [m/s]
constexpr double kYawRate = 0.8;  // [rad/s]
constexpr double kPeriod_s = 0.1;

ScanHits hits_of(const LoggedScan& logged, double spacing_m) {
  ScanHits scan;
  for (std::size_t beam = 0; beam < logged.ranges_m.size(); ++beam) {
    const double range_m = logged.ranges_m[beam];
    if (!(range_m > kLeastRange_m && range_m < kMostRange_m)) continue;
    const Vector2 hit = logged.hit(beam);
    if (scan.hits.empty() || (hit - scan.hits.back()).norm() >= spacing_m) scan.hits.push_back(hit);
  }
  return scan;
}

}  // namespace

std::vector<LogScan> drive_of(const std::vector<LoggedScan>& log, std::uint64_t seed,
                              double spacing_m) {
  SkidOdometry odometry(seed);
  std::vector<LogScan> drive;
  double time_s = 0.0;
  for (const LoggedScan& logged : log) {
    const Pose step = drive.empty() ? Pose{} : relative(drive.back().truth, logged.laser);
    // The logs' own times are not of much use: some are all the same.
    time_s +=
        std::max({kPeriod_s, step.position.norm() / kSpeed, std::abs(step.yaw_rad) / kYawRate});
    LogScan scan{hits_of(logged, spacing_m), odometry.add(step), logged.laser};
    scan.scan.time_s = time_s;
    drive.push_back(std::move(scan));
  }
  return drive;
}

}  // namespace mocha
