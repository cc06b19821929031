#include "perception/sensor/planar_scan.h"

#include <algorithm>
#include <cmath>

namespace mocha {
namespace {

constexpr double kLongestSweep_s = 1.0;
constexpr double kSpareBeams =
    1.5;  // drivers disagree on whether angle_max is the last beam's or the next one's

/// How far a beam without return tells of free space: no farther than its neighbours, because now
/// and then a beam that meets a wall is simply lost.
double seen_free_m(const PlanarScan& scan, std::size_t beam, double clear_m) {
  constexpr std::size_t kNeighbours = 2;
  const std::size_t from = beam - std::min(beam, kNeighbours);
  const std::size_t to = std::min(beam + kNeighbours, scan.ranges_m.size() - 1);
  double nearest_m = std::min<double>(clear_m, scan.ranges_m[beam]);
  if (scan.ranges_m[beam] < scan.range_max_m)
    return nearest_m;  // a return, only too far away to be mapped
  for (std::size_t i = from; i <= to; ++i) {
    const double range = scan.ranges_m[i];
    if (range >= scan.range_min_m) nearest_m = std::min(nearest_m, range);  // false for NaN
  }
  return nearest_m;
}

}  // namespace

double PlanarScan::end_time_s() const {
  return start_time_s + time_increment_s * (static_cast<double>(ranges_m.size()) - 1.0);
}

std::string fault_of(const PlanarScan& scan) {
  if (scan.ranges_m.empty()) return "no beams";
  for (double value : {scan.start_time_s, scan.time_increment_s, scan.angle_min_rad,
                       scan.angle_max_rad, scan.angle_increment_rad, scan.range_min_m}) {
    if (!std::isfinite(value)) return "angles, times or ranges that are not finite";
  }
  if (!(scan.range_max_m > scan.range_min_m) || scan.range_min_m < 0.0) {
    return "range_max is not above range_min";
  }
  if (scan.angle_increment_rad == 0.0 && scan.ranges_m.size() > 1) return "angle_increment is zero";
  const double span = scan.angle_increment_rad * (static_cast<double>(scan.ranges_m.size()) - 1.0);
  if (std::abs(span - (scan.angle_max_rad - scan.angle_min_rad)) >
      kSpareBeams * std::abs(scan.angle_increment_rad)) {
    return "number of ranges does not match the angles";
  }
  if (scan.time_increment_s < 0.0 || scan.end_time_s() - scan.start_time_s > kLongestSweep_s) {
    return "time_increment is negative or makes a sweep longer than 1 s";
  }
  return {};
}

Eigen::Isometry3d interpolate(const SweepPoses& poses, double share) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(poses.first.linear())
                      .slerp(share, Eigen::Quaterniond(poses.last.linear()))
                      .toRotationMatrix();
  pose.translation() = (1.0 - share) * poses.first.translation() + share * poses.last.translation();
  return pose;
}

std::vector<Beam> to_beams(const PlanarScan& scan, const SweepPoses& poses,
                           const BeamReach& reach) {
  const bool moved = !poses.first.isApprox(poses.last, 1e-9);
  const double last = std::max<double>(1.0, static_cast<double>(scan.ranges_m.size()) - 1.0);
  const double clear_m = std::min(reach.clear_m, scan.range_max_m);
  std::vector<Beam> beams;
  beams.reserve(scan.ranges_m.size());
  Eigen::Isometry3d pose = poses.first;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range = scan.ranges_m[i];
    if (std::isnan(range) || range < scan.range_min_m) continue;
    if (moved) pose = interpolate(poses, static_cast<double>(i) / last);
    const bool hit = range < scan.range_max_m && range <= reach.hit_m;
    const double length = hit ? range : seen_free_m(scan, i, clear_m);
    const double angle = scan.angle_min_rad + static_cast<double>(i) * scan.angle_increment_rad;
    beams.push_back({pose.translation(),
                     pose * Vector3(length * std::cos(angle), length * std::sin(angle), 0.0),
                     hit ? BeamEnd::kHit : BeamEnd::kMiss,
                     scan.start_time_s + static_cast<double>(i) * scan.time_increment_s});
  }
  return beams;
}

}  // namespace mocha
