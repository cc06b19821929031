#pragma once

#include <string>
#include <vector>

#include "perception/mapping/map_error.h"
#include "perception/pose_graph/keyframe.h"
#include "perception/pose_graph/pose_graph.h"

namespace mocha {

/// A map as it was driven: keyframes, and what is known between them.
struct DrivenMap {
  PoseGraph graph;
  std::vector<ScanKeyframe> keyframes;  ///< one for each pose of the graph; without surfels
};

/// As text in the format of g2o: VERTEX_SE2 and EDGE_SE2 lines, which its tools read, and a
/// KEYFRAME line after each vertex, with the odometry and the scan [m, rad, s]. Throws MapError
/// naming the file.
void save_driven_map(const DrivenMap& map, const std::string& path);

/// Throws MapError, naming the file and the line, for anything that save_driven_map() does not
/// write.
DrivenMap load_driven_map(const std::string& path);

}  // namespace mocha
