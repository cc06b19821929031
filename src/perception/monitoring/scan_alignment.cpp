#include "perception/monitoring/scan_alignment.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "trajectory/frame_change.h"

namespace mocha {
namespace {

// Of a surface: how far its hits are from its middle, how many they are at least, and how straight.
constexpr double kReach_m = 0.15;
constexpr double kReachPerRange = 0.045;
constexpr int kMostNeighbours = 10;  // on each side
constexpr int kFewestHits = 5;
constexpr double kMostFlat = 0.1;  // variance across over variance along

constexpr std::size_t kHits = 200;  // of the scan that is aligned
constexpr double kReaches_m[] = {0.6, 0.6, 0.45, 0.3, 0.3, 0.2, 0.15, 0.1, 0.1, 0.1};
constexpr double kOnSurface_m = 0.06;
constexpr double kFewestInliers = 0.6;
// Farther from the guess, it has found something else.
constexpr double kFarthest_m = 0.35;
constexpr double kFarthest_rad = 0.35;
constexpr double kFewestAcross = 8.0;  // hits that speak for the least known direction

/// Normal equations of a step of the pose: x, y and the turn about its place.
struct Equations {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  int on_surface = 0;

  void add(const Vector2& normal, const Vector2& arm, double error_m, double weight) {
    const Eigen::Vector3d slope(normal.x(), normal.y(),
                                normal.y() * arm.x() - normal.x() * arm.y());
    information += weight * slope * slope.transpose();
    gradient += weight * error_m * slope;
    if (std::abs(error_m) < kOnSurface_m) ++on_surface;
  }
  /// Of the translation, whatever the turn.
  double least_known() const {
    const Eigen::Vector2d mixed = information.topRightCorner<2, 1>();
    const Eigen::Matrix2d alone = information.topLeftCorner<2, 2>() -
                                  mixed * mixed.transpose() / std::max(1e-9, information(2, 2));
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(alone, Eigen::EigenvaluesOnly)
        .eigenvalues()(0);
  }
};

}  // namespace

ReferenceScan::ReferenceScan(const ScanHits& scan) : sensor_(scan.sensor) {
  for (int i = 0; i < static_cast<int>(scan.hits.size()); ++i) {
    if (const auto surface = surface_at(scan.hits, i)) surfaces_.push_back(*surface);
  }
  std::sort(surfaces_.begin(), surfaces_.end(),
            [](const Surface& a, const Surface& b) { return a.bearing_rad < b.bearing_rad; });
}

std::optional<ReferenceScan::Surface> ReferenceScan::surface_at(const std::vector<Vector2>& hits,
                                                                int index) const {
  const Vector2& hit = hits[index];
  const double reach_m = std::max(kReach_m, kReachPerRange * (hit - sensor_).norm());
  const int count = static_cast<int>(hits.size());
  int number = 0;
  Vector2 sum = Vector2::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  for (int i = std::max(0, index - kMostNeighbours);
       i <= std::min(count - 1, index + kMostNeighbours); ++i) {
    const Vector2 off = hits[i] - hit;
    if (off.norm() > reach_m) continue;
    ++number;
    sum += off;
    squares += off * off.transpose();
  }
  if (number < kFewestHits) return std::nullopt;
  const Vector2 mean = sum / number;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> spread(squares / number -
                                                              mean * mean.transpose());
  if (spread.eigenvalues()(0) > kMostFlat * spread.eigenvalues()(1)) return std::nullopt;
  const Vector2 centre = hit + mean;
  const Vector2 ray = centre - sensor_;
  return Surface{std::atan2(ray.y(), ray.x()), centre, spread.eigenvectors().col(0)};
}

const ReferenceScan::Surface* ReferenceScan::nearest(const Vector2& point, double reach_m) const {
  const Vector2 ray = point - sensor_;
  const double bearing_rad = std::atan2(ray.y(), ray.x());
  const double width_rad = std::asin(std::min(1.0, reach_m / std::max(ray.norm(), reach_m)));
  const Surface* best = nullptr;
  double best_m = reach_m;
  const auto look = [&](double from_rad, double to_rad) {
    auto surface =
        std::lower_bound(surfaces_.begin(), surfaces_.end(), from_rad,
                         [](const Surface& s, double bearing) { return s.bearing_rad < bearing; });
    for (; surface != surfaces_.end() && surface->bearing_rad <= to_rad; ++surface) {
      const double distance_m = (surface->centre - point).norm();
      if (distance_m >= best_m) continue;
      best_m = distance_m;
      best = &*surface;
    }
  };
  for (const double turn_rad : {-2.0 * M_PI, 0.0, 2.0 * M_PI})
    look(bearing_rad + turn_rad - width_rad, bearing_rad + turn_rad + width_rad);
  return best;
}

std::optional<ScanAlignment> ReferenceScan::align(const ScanHits& scan, const Pose& guess) const {
  const ScanHits thin = thinned(scan, kHits);
  if (thin.hits.empty()) return std::nullopt;
  Pose pose = guess;
  Equations equations;
  for (const double reach_m : kReaches_m) {
    equations = {};
    for (const Vector2& seen : thin.hits) {
      const Vector2 hit = composed(pose, {seen, 0.0}).position;
      const Surface* surface = nearest(hit, reach_m);
      if (surface == nullptr) continue;
      const double error_m = surface->normal.dot(hit - surface->centre);
      const double ratio = 3.0 * error_m / reach_m;
      const double root = 1.0 / (1.0 + ratio * ratio);
      equations.add(surface->normal, hit - pose.position, error_m, root * root);
    }
    if (equations.least_known() < kFewestAcross) return std::nullopt;
    const Eigen::Vector3d change = equations.information.ldlt().solve(-equations.gradient);
    pose.position += change.head<2>();
    pose.yaw_rad = wrap_angle(pose.yaw_rad + change.z());
  }
  const Pose off = relative(guess, pose);
  if (off.position.norm() > kFarthest_m || std::abs(off.yaw_rad) > kFarthest_rad)
    return std::nullopt;
  const double inliers = static_cast<double>(equations.on_surface) / thin.hits.size();
  if (inliers < kFewestInliers) return std::nullopt;
  return ScanAlignment{pose, inliers};
}

}  // namespace mocha
