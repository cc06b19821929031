#include "perception/sensor/point_cloud.h"

#include <cmath>
#include <cstdint>
#include <unordered_set>

namespace mocha {
namespace {

/// Names the cube of a point within `reach_m`.
std::uint64_t cube_of(const Vector3& point, double spacing_m) {
  constexpr double kMiddle = 1 << 20;
  std::uint64_t name = 0;
  for (int axis = 0; axis < 3; ++axis) {
    name = (name << 21) | static_cast<std::uint64_t>(std::floor(point[axis] / spacing_m) + kMiddle);
  }
  return name;
}

}  // namespace

std::vector<Beam> to_beams(const std::vector<Eigen::Vector3f>& points,
                           const Eigen::Isometry3d& pose, double time_s, double reach_m,
                           double spacing_m) {
  std::vector<Beam> beams;
  std::unordered_set<std::uint64_t> taken;
  for (const Eigen::Vector3f& measured : points) {
    if (!measured.allFinite()) continue;
    Vector3 point = measured.cast<double>();
    const double range = point.norm();
    const bool near = range <= reach_m;
    if (!near) point *= reach_m / range;
    if (!taken.insert(cube_of(point, spacing_m)).second) continue;
    beams.push_back(
        {pose.translation(), pose * point, near ? BeamEnd::kHit : BeamEnd::kMiss, time_s});
  }
  return beams;
}

}  // namespace mocha
