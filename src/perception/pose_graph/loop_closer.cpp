#include "perception/pose_graph/loop_closer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trajectory/frame_change.h"

namespace mocha {
namespace {

constexpr double kLostSigma_m = 10.0;
constexpr double kLostSigma_rad = 1.0;
constexpr double kSpacing_m = 1.0;  // between searches, unless there is something to confirm
// The place around a candidate.
constexpr double kPlaceReach_m = 8.0;
constexpr std::size_t kMostOfPlace = 15;
constexpr double kPlaceRadius_m = 15.0;
// The window of a search.
constexpr double kWindow_m = 1.0;
constexpr double kMostWindow_m = 8.0;
constexpr double kWindow_rad = 0.1;
constexpr double kMostWindow_rad = 0.8;
// What is believed.
constexpr double kExpected_m = 0.5;  // a place so near needs no confirmation
constexpr int kMostKeyframesBetween = 15;
constexpr double kSame_m = 0.3;
constexpr double kSamePerMetre = 0.05;
constexpr double kSame_rad = 0.06;

}  // namespace

std::vector<LoopClosure> LoopCloser::look(const PoseGraph& graph,
                                          const std::vector<ScanKeyframe>& keyframes,
                                          int keyframe) {
  const Pose& here = graph.poses()[keyframe];
  if (looked_at_ && !unconfirmed_ && (here.position - *looked_at_).norm() < kSpacing_m) return {};
  const auto found = candidate(graph, keyframe);
  if (!found) return {};
  looked_at_ = here.position;
  const std::vector<int> seen = seen_together(keyframe, graph);
  std::vector<int> place = graph.surely_near(found->keyframe, kTogetherSigma_m, kPlaceReach_m);
  place.resize(std::min(place.size(), kMostOfPlace));
  place.erase(std::remove_if(place.begin(), place.end(),
                             [&](int id) { return std::count(seen.begin(), seen.end(), id) > 0; }),
              place.end());
  ++tried_;
  const SearchWindow window{here, std::min(kMostWindow_m, kWindow_m + 3.0 * found->sigma_m),
                            std::min(kMostWindow_rad, kWindow_rad + 3.0 * found->sigma_rad)};
  const LoopMatcher matcher(chosen(place, graph, keyframes), kPlaceRadius_m);
  return judge(matcher.match(chosen(seen, graph, keyframes), window), graph, keyframe);
}

/// The nearest keyframe, as far as one knows, of those that are not surely near.
std::optional<LoopCloser::Candidate> LoopCloser::candidate(const PoseGraph& graph,
                                                           int keyframe) const {
  const std::vector<PoseGraph::Uncertainty> known = graph.uncertainties(keyframe, kLostSigma_m);
  std::optional<Candidate> nearest;
  double nearest_m = 0.0;
  for (int i = 0; i < graph.size(); ++i) {
    const double sigma_m =
        known[i].is_known ? std::sqrt(known[i].position_variance_m2) : kLostSigma_m;
    const double far_m = (graph.poses()[i].position - graph.poses()[keyframe].position).norm();
    if (sigma_m <= kTogetherSigma_m || far_m > options_.radius_m + 2.0 * sigma_m) continue;
    if (nearest && far_m >= nearest_m) continue;
    nearest_m = far_m;
    nearest = {i, sigma_m,
               known[i].is_known ? std::sqrt(known[i].yaw_variance_rad2) : kLostSigma_rad};
  }
  return nearest;
}

std::vector<LoopClosure> LoopCloser::judge(const std::vector<LoopMatch>& matches,
                                           const PoseGraph& graph, int keyframe) {
  if (matches.empty()) return {};
  const LoopMatch& match = matches.front();
  const bool has_rival = matches.size() > 1 && matches[1].quality > match.quality - kMatchRivalry;
  if (match.quality < options_.quality_of_several() || has_rival) return {};
  const Pose& here = graph.poses()[keyframe];
  const Pose& found = match.place.pose;
  const LoopClosure loop{keyframe, match.place};
  std::vector<LoopClosure> loops;
  const bool is_good = match.quality >= options_.quality;
  if (unconfirmed_ && is_confirmed_by(loop, graph)) {
    loops = {unconfirmed_->loop, loop};
  } else if (is_good && (found.position - here.position).norm() < kExpected_m) {
    loops = {loop};
  }
  unconfirmed_.reset();
  if (loops.empty()) unconfirmed_ = {loop, composed(found, relative(here, Pose{})), is_good};
  return loops;
}

bool LoopCloser::is_confirmed_by(const LoopClosure& loop, const PoseGraph& graph) const {
  const int before = unconfirmed_->loop.keyframe;
  if (std::abs(loop.keyframe - before) > kMostKeyframesBetween) return false;
  const Pose& here = graph.poses()[loop.keyframe];
  const double driven_m = (graph.poses()[before].position - here.position).norm();
  const Pose expected = composed(unconfirmed_->correction, here);
  const Pose& found = loop.place.pose;
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
