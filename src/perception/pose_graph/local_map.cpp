#include "perception/pose_graph/local_map.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "perception/localization/branch_and_bound_matcher.h"
#include "perception/pose_graph/scan_grid.h"
#include "trajectory/frame_change.h"

namespace mocha {
namespace {

// Keyframes that a scan is placed among: so near, and their places known so well.
constexpr double kSureSigma_m = 0.08;
constexpr double kAround_m = 6.0;
constexpr std::size_t kMostAround = 12;
constexpr double kPairReach_m = 0.6;
constexpr double kWellExplained = 0.4;  // scans that are explained by less are looked for around
constexpr BranchAndBoundMatcher::Options kSearch{200000, 120, 0.2};
constexpr double kSearchReach_m = 12.0;
constexpr double kCell_m = 0.05;
constexpr double kWallReach_m = 1.0;
// Of the agreement of two keyframes.
constexpr int kLeastSurfels = 8;
constexpr double kLeastShare = 0.1;  // of the surfels that agree with any
constexpr double kFaintSigma = 1.0;  // [m, rad] what every two keyframes know of each other

}  // namespace

Alignment LocalMap::place(const ScanHits& scan, const std::vector<Surfel>& surfels,
                          const PoseEstimate& prior) const {
  Alignment best = surfels_.align(surfels, prior, kPairReach_m);
  if (best.explained >= kWellExplained) return best;
  const Alignment found = search(scan, surfels, prior);
  return found.explained > best.explained ? found : best;
}

Alignment LocalMap::search(const ScanHits& scan, const std::vector<Surfel>& surfels,
                           const PoseEstimate& prior) const {
  const LikelihoodField walls(grid_of(keyframes_, prior.pose.position, kSearchReach_m, kCell_m),
                              kWallReach_m);
  const SearchWindow window = SearchWindow::around(prior);
  Alignment best;
  for (const auto& found : BranchAndBoundMatcher(walls, kSearch).find(scan, window).places) {
    const Alignment alignment =
        surfels_.align(surfels, {found.pose, prior.covariance}, kPairReach_m);
    if (alignment.explained > best.explained) best = alignment;
  }
  return best;
}

std::vector<int> keyframes_around(int centre, int end, const PoseGraph& graph) {
  std::vector<int> around = graph.surely_near(centre, kSureSigma_m, kAround_m);
  around.erase(std::remove_if(around.begin(), around.end(), [&](int id) { return id >= end; }),
               around.end());
  around.resize(std::min(around.size(), kMostAround));
  return around;
}

void link(PoseGraph& graph, int keyframe, const Alignment& place, bool may_be_wrong) {
  int all = 0;
  for (const Agreement& agreement : place.agreements) all += agreement.surfels;
  for (const Agreement& agreement : place.agreements) {
    if (agreement.surfels < std::max<double>(kLeastSurfels, kLeastShare * all)) continue;
    const Eigen::Matrix3d information =
        agreement.error.information + Eigen::Matrix3d::Identity() / (kFaintSigma * kFaintSigma);
    const Eigen::Vector3d change = -information.ldlt().solve(agreement.error.gradient);
    const Pose best{place.pose.position + change.head<2>(), place.pose.yaw_rad + change.z()};
    const Pose& from = graph.poses()[agreement.keyframe];
    Eigen::Matrix3d to_frame = Eigen::Matrix3d::Identity();
    to_frame.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(-from.yaw_rad).toRotationMatrix();
    graph.add({agreement.keyframe, keyframe, relative(from, best),
               to_frame * information * to_frame.transpose(), may_be_wrong});
  }
}

}  // namespace mocha
