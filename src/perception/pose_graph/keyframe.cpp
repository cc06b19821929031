#include "perception/pose_graph/keyframe.h"

namespace mocha {

std::vector<PlacedKeyframe> chosen(const std::vector<int>& ids, const PoseGraph& graph,
                                   const std::vector<ScanKeyframe>& keyframes) {
  std::vector<PlacedKeyframe> result;
  for (const int id : ids) result.push_back({id, graph.poses()[id], &keyframes[id]});
  return result;
}

}  // namespace mocha
