#pragma once

#include "perception/pose_graph/pose_graph.h"

namespace mocha {

/// Moves the poses to where all constraints agree best (least squares; those that may be wrong
/// with Cauchy's loss). The first keyframe stays where it is. A graph for which no better poses are
/// found stays as it is.
void optimize(PoseGraph& graph);

}  // namespace mocha
