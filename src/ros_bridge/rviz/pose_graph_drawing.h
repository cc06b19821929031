#pragma once

#include "perception/pose_graph/pose_graph.h"
#include "ros_bridge/rviz/markers.h"

namespace mocha {

/// The way of the keyframes, and red lines where loops were closed.
void draw_pose_graph(const PoseGraph& graph, Drawing& drawing);

}  // namespace mocha
