#include "perception/pose_graph/loop_matcher.h"

#include <algorithm>
#include <utility>

#include "perception/localization/scan_fit.h"
#include "perception/pose_graph/scan_grid.h"
#include "trajectory/frame_change.h"

namespace mocha {
namespace {

constexpr double kSeenReach_m = 6.0;
constexpr std::size_t kMostSeen = 8;
constexpr double kPlaceCell_m = 0.05;
constexpr double kPlaceWallReach_m = 1.0;
constexpr double kTolerance_m = 0.1;
constexpr BranchAndBoundMatcher::Options kLoopSearch{2000000, 200, 0.4};
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

std::vector<int> seen_together(int keyframe, const PoseGraph& graph) {
  std::vector<int> seen = graph.surely_near(keyframe, kTogetherSigma_m, kSeenReach_m);
  seen.resize(std::min(seen.size(), kMostSeen));
  return seen;
}

LoopMatcher::LoopMatcher(std::vector<PlacedKeyframe> place, double reach_m)
    : surfels_(place),
      walls_(grid_of(place, place.front().pose.position, reach_m, kPlaceCell_m), kPlaceWallReach_m),
      search_(walls_, kLoopSearch) {}

LoopMatch LoopMatcher::judged(const std::vector<PlacedKeyframe>& seen,
                              const std::vector<Surfel>& surfels, const Pose& expected) const {
  const Eigen::Vector3d sigma(kFoundSigma_m, kFoundSigma_m, kFoundSigma_rad);
  LoopMatch match;
  match.place =
      surfels_.align(surfels, {expected, sigma.cwiseAbs2().asDiagonal()}, kLoopPairReach_m);
  const ScanFit fit = joint_fit(seen, match.place.pose, walls_);
  match.known = static_cast<double>(fit.known()) / std::max(1, fit.hits());
  match.quality = fit.quality();
  return match;
}

LoopMatch LoopMatcher::match_near(const std::vector<PlacedKeyframe>& seen,
                                  const Pose& expected) const {
  return judged(seen, joint(seen).surfels, expected);
}

std::vector<LoopMatch> LoopMatcher::match(const std::vector<PlacedKeyframe>& seen,
                                          const SearchWindow& window) const {
  const JointScan scan = joint(seen);
  std::vector<LoopMatch> all;
  for (const auto& found : search_.find(scan.hits, window).places) {
    const LoopMatch match = judged(seen, scan.surfels, found.pose);
    if (match.known * match.quality >= kLeastOnWalls) all.push_back(match);
  }
  std::sort(all.begin(), all.end(),
            [](const LoopMatch& a, const LoopMatch& b) { return a.quality > b.quality; });
  std::vector<LoopMatch> result;
  for (LoopMatch& match : all) {
    const bool is_same = std::any_of(result.begin(), result.end(), [&](const LoopMatch& better) {
      return (better.place.pose.position - match.place.pose.position).norm() < kSamePlace_m;
    });
    if (!is_same) result.push_back(std::move(match));
  }
  return result;
}

}  // namespace mocha
