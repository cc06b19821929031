#include "perception/pose_graph/loop_matcher.h"

#include <algorithm>

#include "perception/localization/scan_fit.h"
#include "perception/pose_graph/scan_grid.h"
#include "trajectory/frame_change.h"

namespace mocha {
namespace {

constexpr double kPlaceRadius_m = 15.0;  // of the place around its first keyframe
constexpr double kPlaceCell_m = 0.05;
constexpr double kPlaceWallReach_m = 1.0;
constexpr double kTolerance_m = 0.1;
constexpr BranchAndBoundMatcher::Options kLoopSearch{200000, 200, 0.4};
constexpr double kFoundSigma_m = 0.3;  // of what the search finds
constexpr double kFoundSigma_rad = 0.1;
constexpr double kLoopPairReach_m = 0.3;
constexpr double kLeastOnWalls = 0.4;  // share of all hits
constexpr double kSamePlace_m = 0.3;

/// All that the keyframes saw, as seen from the first.
struct JointScan {
  ScanHits hits;
  std::vector<Surfel> surfels;
};

JointScan joint(const std::vector<PlacedKeyframe>& keyframes) {
  JointScan result;
  for (const PlacedKeyframe& each : keyframes) {
    const Pose from = relative(keyframes.front().pose, each.pose);
    for (const Vector2& hit : each.keyframe->scan.hits)
      result.hits.hits.push_back(composed(from, {hit, 0.0}).position);
    for (const Surfel& surfel : each.keyframe->surfels)
      result.surfels.push_back(placed(from, surfel));
  }
  return result;
}

/// Of all keyframes, if the first of them stands at `pose`.
ScanFit joint_fit(const std::vector<PlacedKeyframe>& keyframes, const Pose& pose,
                  const LikelihoodField& walls) {
  ScanFit sum;
  for (const PlacedKeyframe& each : keyframes) {
    const Pose at = composed(pose, relative(keyframes.front().pose, each.pose));
    const ScanFit fit = fit_of(each.keyframe->scan, at, walls, kTolerance_m);
    sum.on_wall += fit.on_wall;
    sum.in_free += fit.in_free;
    sum.behind += fit.behind;
    sum.unknown += fit.unknown;
  }
  return sum;
}

}  // namespace

LoopMatch match_loop(const std::vector<PlacedKeyframe>& seen,
                     const std::vector<PlacedKeyframe>& place, const SearchWindow& window) {
  const SurfelMap surfels(place);
  const LikelihoodField walls(
      grid_of(place, place.front().pose.position, kPlaceRadius_m, kPlaceCell_m), kPlaceWallReach_m);
  const JointScan scan = joint(seen);
  const Eigen::Matrix3d loose = Eigen::Vector3d(kFoundSigma_m, kFoundSigma_m, kFoundSigma_rad)
                                    .array()
                                    .square()
                                    .matrix()
                                    .asDiagonal();
  LoopMatch best;
  for (const auto& found :
       BranchAndBoundMatcher(walls, kLoopSearch).find(scan.hits, window).places) {
    const Alignment alignment = surfels.align(scan.surfels, {found.pose, loose}, kLoopPairReach_m);
    const ScanFit fit = joint_fit(seen, alignment.pose, walls);
    if (fit.on_wall < kLeastOnWalls * fit.hits()) continue;
    const bool is_other =
        best.quality > 0.0 &&
        (best.place.pose.position - alignment.pose.position).norm() > kSamePlace_m;
    if (fit.quality() > best.quality) {
      best = {alignment, fit.quality(), is_other ? best.quality : best.rival};
    } else if (is_other) {
      best.rival = std::max(best.rival, fit.quality());
    }
  }
  return best;
}

}  // namespace mocha
