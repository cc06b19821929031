#include "perception/pose_graph/map_merging.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "perception/pose_graph/graph_optimizer.h"
#include "perception/pose_graph/local_map.h"
#include "trajectory/frame_change.h"

namespace mocha {
namespace {

constexpr double kLooseSigma_m = 0.1;
constexpr double kLooseSigma_rad = 0.05;

/// Drives through the other map again, from where it was found in the first one.
class Merging {
 public:
  Merging(DrivenMap map, const DrivenMap& other, const MapMatch& match,
          const LoopCloserOptions& loops)
      : map_(std::move(map)), first_(map_.graph.size()), closer_(loops) {
    map_.graph.append(other.graph, match.frame);
    std::copy(other.keyframes.begin(), other.keyframes.end(), std::back_inserter(map_.keyframes));
    close(match.found, first_);
    const int anchor = first_ + match.found.front().keyframe;
    for (int id = anchor; id < map_.graph.size(); ++id) join(id);
    for (int id = anchor - 1; id >= first_; --id) join(id);
    close(closer_.take_unconfirmed(), 0);
    optimize(map_.graph);
  }

  DrivenMap take() { return std::move(map_); }

 private:
  void close(const std::vector<LoopClosure>& loops, int offset) {
    if (loops.empty()) return;
    for (const LoopClosure& loop : loops)
      link(map_.graph, offset + loop.keyframe, loop.place, true);
    optimize(map_.graph);
  }

  /// To the keyframes of the first map around it; where it is not surely near to any, where it
  /// finds some.
  void join(int id) {
    const std::vector<int> around = keyframes_around(id, first_, map_.graph);
    if (around.empty()) {
      close(closer_.look(map_.graph, map_.keyframes, id), 0);
      return;
    }
    const ScanKeyframe& keyframe = map_.keyframes[id];
    const PoseEstimate prior{
        map_.graph.poses()[id],
        Eigen::Vector3d(kLooseSigma_m, kLooseSigma_m, kLooseSigma_rad).cwiseAbs2().asDiagonal()};
    const Alignment place = LocalMap(chosen(around, map_.graph, map_.keyframes))
                                .place(keyframe.scan, keyframe.surfels, prior);
    if (place.explained >= LocalMap::kExplained) link(map_.graph, id, place, true);
  }

  DrivenMap map_;
  const int first_;  // keyframe of the other map
  LoopCloser closer_;
};

}  // namespace

MergedMaps merged(DrivenMap map, DrivenMap other, const LoopCloserOptions& loops,
                  std::size_t hits) {
  find_surfels(map.keyframes, hits);
  find_surfels(other.keyframes, hits);
  const MapMatch match = match_maps(map, other, loops);
  if (match.fault != MapMatch::Fault::kNone) return {match.fault, {}};
  return {match.fault, Merging(std::move(map), other, match, loops).take()};
}

}  // namespace mocha
