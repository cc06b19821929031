#include "perception/pose_graph/loop_closer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trajectory/frame_change.h"

namespace mocha {
namespace {

constexpr double kTogetherSigma_m = 0.16;  // keyframes known to that belong together
constexpr double kLostSigma_m = 10.0;
constexpr double kLostSigma_rad = 1.0;
constexpr double kSpacing_m = 1.0;  // between searches, unless there is something to confirm
// What is matched: the keyframe and those before it, with those around the candidate.
constexpr double kSeenReach_m = 6.0;
constexpr std::size_t kMostSeen = 8;
constexpr double kPlaceReach_m = 8.0;
constexpr std::size_t kMostOfPlace = 15;
// The window of a search.
constexpr double kWindow_m = 1.0;
constexpr double kMostWindow_m = 8.0;
constexpr double kWindow_rad = 0.1;
constexpr double kMostWindow_rad = 0.8;
// What is believed.
constexpr double kRivalry = 0.1;
constexpr double kLessQuality = 0.15;  // is enough where several keyframes find the same
constexpr double kExpected_m = 0.5;    // a place so near needs no confirmation
constexpr int kMostKeyframesBetween = 15;
constexpr double kSame_m = 0.3;
constexpr double kSamePerMetre = 0.05;
constexpr double kSame_rad = 0.06;

}  // namespace

std::vector<LoopClosure> LoopCloser::look(const PoseGraph& graph,
                                          const std::vector<ScanKeyframe>& keyframes) {
  const int newest = graph.size() - 1;
  const Pose& here = graph.poses()[newest];
  if (looked_at_ && !unconfirmed_ && (here.position - *looked_at_).norm() < kSpacing_m) return {};
  const auto found = candidate(graph);
  if (!found) return {};
  looked_at_ = here.position;
  const std::vector<int> seen =
      graph.surely_near(newest, kTogetherSigma_m, kSeenReach_m, kMostSeen);
  std::vector<int> place =
      graph.surely_near(found->keyframe, kTogetherSigma_m, kPlaceReach_m, kMostOfPlace);
  place.erase(std::remove_if(place.begin(), place.end(),
                             [&](int id) { return std::count(seen.begin(), seen.end(), id) > 0; }),
              place.end());
  ++tried_;
  const SearchWindow window{here, std::min(kMostWindow_m, kWindow_m + 3.0 * found->sigma_m),
                            std::min(kMostWindow_rad, kWindow_rad + 3.0 * found->sigma_rad)};
  return judge(match_loop(chosen(seen, graph, keyframes), chosen(place, graph, keyframes), window),
               graph);
}

/// The nearest keyframe, as far as one knows, of those that are not surely near.
std::optional<LoopCloser::Candidate> LoopCloser::candidate(const PoseGraph& graph) const {
  const int newest = graph.size() - 1;
  const std::vector<PoseGraph::Uncertainty> known = graph.uncertainties(newest, kLostSigma_m);
  std::optional<Candidate> nearest;
  double nearest_m = 0.0;
  for (int i = 0; i < newest; ++i) {
    const double sigma_m =
        known[i].is_known ? std::sqrt(known[i].position_variance_m2) : kLostSigma_m;
    const double far_m = (graph.poses()[i].position - graph.poses()[newest].position).norm();
    if (sigma_m <= kTogetherSigma_m || far_m > options_.radius_m + 2.0 * sigma_m) continue;
    if (nearest && far_m >= nearest_m) continue;
    nearest_m = far_m;
    nearest = {i, sigma_m,
               known[i].is_known ? std::sqrt(known[i].yaw_variance_rad2) : kLostSigma_rad};
  }
  return nearest;
}

std::vector<LoopClosure> LoopCloser::judge(const LoopMatch& match, const PoseGraph& graph) {
  if (match.quality < options_.quality - kLessQuality || match.rival > match.quality - kRivalry)
    return {};
  const int newest = graph.size() - 1;
  const Pose& here = graph.poses()[newest];
  const Pose& found = match.place.pose;
  const LoopClosure loop{newest, match.place};
  std::vector<LoopClosure> loops;
  const bool is_good = match.quality >= options_.quality;
  if (unconfirmed_ && confirms(here, found, graph)) {
    loops = {unconfirmed_->loop, loop};
  } else if (is_good && (found.position - here.position).norm() < kExpected_m) {
    loops = {loop};
  }
  unconfirmed_.reset();
  if (loops.empty()) unconfirmed_ = {loop, composed(found, relative(here, Pose{})), is_good};
  return loops;
}

bool LoopCloser::confirms(const Pose& here, const Pose& found, const PoseGraph& graph) const {
  const int before = unconfirmed_->loop.keyframe;
  if (graph.size() - 1 - before > kMostKeyframesBetween) return false;
  const Pose expected = composed(unconfirmed_->correction, here);
  const double driven_m = (graph.poses()[before].position - here.position).norm();
  return (expected.position - found.position).norm() < kSame_m + kSamePerMetre * driven_m &&
         std::abs(wrap_angle(expected.yaw_rad - found.yaw_rad)) < kSame_rad;
}

std::vector<LoopClosure> LoopCloser::take_unconfirmed() {
  std::vector<LoopClosure> loops;
  if (unconfirmed_ && unconfirmed_->is_good) loops = {unconfirmed_->loop};
  unconfirmed_.reset();
  return loops;
}

}  // namespace mocha
