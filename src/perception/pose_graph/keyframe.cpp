#include "perception/pose_graph/keyframe.h"

namespace mocha {

void find_surfels(std::vector<ScanKeyframe>& keyframes, std::size_t most) {
  for (ScanKeyframe& keyframe : keyframes) keyframe.surfels = surfels_of(keyframe.scan, most);
}

std::vector<PlacedKeyframe> chosen(const std::vector<int>& ids, const PoseGraph& graph,
                                   const std::vector<ScanKeyframe>& keyframes) {
  std::vector<PlacedKeyframe> result;
  for (const int id : ids) result.push_back({id, graph.poses()[id], &keyframes[id]});
  return result;
}

}  // namespace mocha
