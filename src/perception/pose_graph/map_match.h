#pragma once

#include <vector>

#include "perception/pose_graph/graph_file.h"
#include "perception/pose_graph/loop_closer.h"

namespace mocha {

/// How one map lies in another.
struct MapMatch {
  enum class Fault { kNone, kNothingInCommon, kAmbiguous };

  Fault fault = Fault::kNothingInCommon;
  Pose frame;                      ///< of the other map, in the map
  std::vector<LoopClosure> found;  ///< keyframes of the other map, their places in the map
};

/// Looks all over a map for places of another one. Each that is found says how the maps lie; the
/// other places have to fit that, several of them. Ambiguous are maps that may lie in another way
/// as well.
/// Keyframes must have their surfels.
MapMatch match_maps(const DrivenMap& map, const DrivenMap& other, const LoopCloserOptions& options);

}  // namespace mocha
