#include "perception/pose_graph/surfels.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <optional>

namespace mocha {
namespace {

// How far along the wall neighbours of a hit have a say: at least so far, and farther where the
// beams are far apart.
constexpr double kNeighbourhood_m = 0.25;
constexpr double kNeighbourhoodPerRange = 0.05;
constexpr int kMostNeighbours = 10;  // on each side
constexpr int kLeastHits = 3;
constexpr double kNormalSigma_rad = 0.1;  // normals that are less exact are none
constexpr double kRounding_m = 0.003;     // of ranges: hits on a line are not exact

/// Mean and scatter of points, as seen from one of them.
struct Scatter {
  int count = 0;
  Vector2 sum = Vector2::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();

  void add(const Vector2& by) {
    ++count;
    sum += by;
    squares += by * by.transpose();
  }
  Vector2 mean() const { return sum / count; }
  Eigen::Matrix2d covariance() const { return squares / count - mean() * mean().transpose(); }
};

Scatter around(const ScanHits& scan, int i, double reach_m) {
  const int count = static_cast<int>(scan.hits.size());
  Scatter scatter;
  scatter.add(Vector2::Zero());
  for (const int step : {-1, 1}) {
    for (int j = i + step; j >= 0 && j < count && std::abs(j - i) <= kMostNeighbours; j += step) {
      const Vector2 by = scan.hits[j] - scan.hits[i];
      if (by.norm() > reach_m) break;
      scatter.add(by);
    }
  }
  return scatter;
}

std::optional<Surfel> surfel_at(const ScanHits& scan, int i) {
  const Vector2& hit = scan.hits[i];
  const Vector2 to_sensor = scan.sensor - hit;
  const Scatter scatter =
      around(scan, i, std::max(kNeighbourhood_m, kNeighbourhoodPerRange * to_sensor.norm()));
  if (scatter.count < kLeastHits) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(scatter.covariance());
  // The variance of the direction of a line through so many points of that scatter.
  const double across_m2 = axes.eigenvalues()[0] + kRounding_m * kRounding_m;
  if (across_m2 > kNormalSigma_rad * kNormalSigma_rad * scatter.count * axes.eigenvalues()[1])
    return std::nullopt;
  Vector2 normal = axes.eigenvectors().col(0);
  if (normal.dot(to_sensor) < 0.0) normal = -normal;
  return Surfel{hit + normal * normal.dot(scatter.mean()), normal};
}

}  // namespace

std::vector<Surfel> surfels_of(const ScanHits& scan, std::size_t most) {
  std::vector<Surfel> all;
  for (int i = 0; i < static_cast<int>(scan.hits.size()); ++i) {
    if (const auto surfel = surfel_at(scan, i)) all.push_back(*surfel);
  }
  return evenly_chosen(all, most);
}

Surfel placed(const Pose& frame, const Surfel& surfel) {
  const Eigen::Rotation2Dd turned(frame.yaw_rad);
  return {frame.position + turned * surfel.point, turned * surfel.normal};
}

}  // namespace mocha
