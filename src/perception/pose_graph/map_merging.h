#pragma once

#include <cstddef>

#include "perception/pose_graph/map_match.h"

namespace mocha {

struct MergedMaps {
  MapMatch::Fault fault;  ///< where there is one, there is no map
  DrivenMap map;          ///< the keyframes of the first, and those of the other behind them
};

/// Makes one map of two that were driven, whatever their origins, if they have places in common.
/// The first keyframe of the first stays where it is. Surfels are found anew, at most `hits` of a
/// scan.
MergedMaps merged(DrivenMap map, DrivenMap other, const LoopCloserOptions& loops, std::size_t hits);

}  // namespace mocha
