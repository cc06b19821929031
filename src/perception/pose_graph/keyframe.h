#pragma once

#include <cstddef>
#include <vector>

#include "perception/pose_graph/pose_graph.h"
#include "perception/pose_graph/surfels.h"
#include "perception/sensor/scan_hits.h"

namespace mocha {

/// A scan that is kept.
struct ScanKeyframe {
  Pose odometry;                ///< of the robot, in the odometry frame of its drive
  ScanHits scan;                ///< as seen from the robot
  std::vector<Surfel> surfels;  ///< of the scan
};

/// Finds the surfels of all scans, at most `most` of each.
void find_surfels(std::vector<ScanKeyframe>& keyframes, std::size_t most);

/// A keyframe and where its robot stood.
struct PlacedKeyframe {
  int id;
  Pose pose;
  const ScanKeyframe* keyframe;  ///< never null
};

/// Some keyframes of a graph.
std::vector<PlacedKeyframe> chosen(const std::vector<int>& ids, const PoseGraph& graph,
                                   const std::vector<ScanKeyframe>& keyframes);

}  // namespace mocha
