#include "perception/pose_graph/surfel_map.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <nanoflann.hpp>
#include <optional>

#include "trajectory/frame_change.h"

namespace mocha {
namespace {

constexpr int kMostAlignmentSteps = 20;
constexpr double kLastReach_m = 0.15;
constexpr double kShrinking = 0.6;  // of the reach, from step to step
constexpr double kAlike = 0.7;      // cosine between the normals of a pair
constexpr std::size_t kNeighbours = 4;
constexpr double kStill_m = 5e-4;
constexpr double kStill_rad = 2e-4;
constexpr double kHitSigma_m = 0.03;
constexpr double kIndependentHits = 40.0;  // more add no certainty: their errors are alike

}  // namespace

/// The surfels of all keyframes, by place.
struct SurfelMap::Index {
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Index>,
                                                   Index, 2, std::size_t>;

  explicit Index(const std::vector<PlacedKeyframe>& keyframes) {
    for (const PlacedKeyframe& placed_keyframe : keyframes) {
      for (const Surfel& surfel : placed_keyframe.keyframe->surfels) {
        surfels.push_back(placed(placed_keyframe.pose, surfel));
        owners.push_back(placed_keyframe.id);
      }
    }
    tree.emplace(2, *this, nanoflann::KDTreeSingleIndexAdaptorParams{});
  }

  // What nanoflann asks for.
  std::size_t kdtree_get_point_count() const { return surfels.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return surfels[i].point[axis]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }

  std::vector<Surfel> surfels;
  std::vector<int> owners;
  std::optional<Tree> tree;
};

/// A surfel of a scan, on a wall.
struct SurfelMap::Pair {
  double error_m;
  Eigen::Vector3d slope;  // of the error, by the pose
  double weight;
  int keyframe;

  void add_to(QuadraticError& sum) const {
    sum.information += weight * slope * slope.transpose();
    sum.gradient += weight * error_m * slope;
  }
};

SurfelMap::SurfelMap(const std::vector<PlacedKeyframe>& keyframes)
    : index_(std::make_unique<Index>(keyframes)) {}

SurfelMap::~SurfelMap() = default;

std::vector<SurfelMap::Pair> SurfelMap::pairs(const std::vector<Surfel>& scan, const Pose& pose,
                                              double reach_m) const {
  const double share = std::min(1.0, kIndependentHits / static_cast<double>(scan.size()));
  std::vector<Pair> result;
  std::array<std::size_t, kNeighbours> found;
  std::array<double, kNeighbours> distances_m2;
  for (const Surfel& seen : scan) {
    const Surfel surfel = placed(pose, seen);
    const std::size_t count = index_->tree->knnSearch(surfel.point.data(), kNeighbours,
                                                      found.data(), distances_m2.data());
    for (std::size_t k = 0; k < count && distances_m2[k] <= reach_m * reach_m; ++k) {
      const Surfel& wall = index_->surfels[found[k]];
      if (wall.normal.dot(surfel.normal) < kAlike) continue;
      const Vector2 across = (wall.normal + surfel.normal).normalized();
      const Vector2 lever = surfel.point - pose.position;
      const double error_m = across.dot(surfel.point - wall.point);
      const double damping = 1.0 + std::pow(2.0 * error_m / reach_m, 2);
      result.push_back({error_m,
                        {across.x(), across.y(), across.dot(Vector2(-lever.y(), lever.x()))},
                        share / std::pow(kHitSigma_m * damping, 2),
                        index_->owners[found[k]]});
      break;
    }
  }
  return result;
}

Alignment SurfelMap::align(const std::vector<Surfel>& scan, const PoseEstimate& prior,
                           double reach_m) const {
  Alignment result;
  result.pose = prior.pose;
  result.covariance = prior.covariance;
  if (scan.empty()) return result;
  const Eigen::Matrix3d known = prior.covariance.inverse();
  for (int step = 0; step < kMostAlignmentSteps; ++step) {
    Eigen::Vector3d off;
    off << result.pose.position - prior.pose.position,
        wrap_angle(result.pose.yaw_rad - prior.pose.yaw_rad);
    QuadraticError error{known, known * off};
    for (const Pair& pair : pairs(scan, result.pose, reach_m)) pair.add_to(error);
    const Eigen::Vector3d change = -error.information.ldlt().solve(error.gradient);
    result.pose.position += change.head<2>();
    result.pose.yaw_rad = wrap_angle(result.pose.yaw_rad + change.z());
    result.covariance = error.information.inverse();
    if (reach_m <= kLastReach_m && change.head<2>().norm() < kStill_m &&
        std::abs(change.z()) < kStill_rad)
      break;
    reach_m = std::max(kLastReach_m, kShrinking * reach_m);
  }
  const std::vector<Pair> last = pairs(scan, result.pose, kLastReach_m);
  result.explained = static_cast<double>(last.size()) / static_cast<double>(scan.size());
  for (const Pair& pair : last) {
    auto agreement =
        std::find_if(result.agreements.begin(), result.agreements.end(),
                     [&](const Agreement& other) { return other.keyframe == pair.keyframe; });
    if (agreement == result.agreements.end())
      agreement = result.agreements.insert(agreement, Agreement{pair.keyframe, 0, {}});
    ++agreement->surfels;
    pair.add_to(agreement->error);
  }
  return result;
}

}  // namespace mocha
