#pragma once

#include <utility>
#include <vector>

#include "perception/pose_graph/surfel_map.h"

namespace mocha {

/// What some keyframes saw around a place, for further scans to be placed in.
class LocalMap {
 public:
  /// Share of a scan; one of which less is explained is not placed.
  static constexpr double kExplained = 0.25;

  /// The keyframes must outlive this.
  explicit LocalMap(std::vector<PlacedKeyframe> keyframes)
      : keyframes_(std::move(keyframes)), surfels_(keyframes_) {}

  /// Where a scan was taken, near to the prior; where that explains little of the scan, wherever
  /// the prior lets it be.
  Alignment place(const ScanHits& scan, const std::vector<Surfel>& surfels,
                  const PoseEstimate& prior) const;

 private:
  Alignment search(const ScanHits& scan, const std::vector<Surfel>& surfels,
                   const PoseEstimate& prior) const;

  std::vector<PlacedKeyframe> keyframes_;
  SurfelMap surfels_;
};

/// Keyframes that a scan at `centre` is placed among: the nearest whose places are known well as
/// seen from there, of the first `end` of the graph.
std::vector<int> keyframes_around(int centre, int end, const PoseGraph& graph);

/// Constrains a keyframe of the graph to each of those that it agrees with at the place where it
/// was found: what is known of their relative pose is what the errors between the two say.
void link(PoseGraph& graph, int keyframe, const Alignment& place, bool may_be_wrong);

}  // namespace mocha
