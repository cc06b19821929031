#include "ros_bridge/rviz/pose_graph_drawing.h"

#include <cstdlib>

namespace mocha {
namespace {

constexpr double kWay_m = 0.04;
constexpr double kLoop_m = 0.02;
const std_msgs::ColorRGBA kWayColor = color(0.2, 0.45, 0.8, 0.9);
const std_msgs::ColorRGBA kLoopColor = color(0.85, 0.15, 0.15, 0.8);

}  // namespace

void draw_pose_graph(const PoseGraph& graph, Drawing& drawing) {
  std::vector<Vector2> way;
  for (const Pose& pose : graph.poses()) way.push_back(pose.position);
  if (way.size() > 1) drawing.add_line("keyframes", way, kWay_m, kWayColor, false);
  for (const Constraint& constraint : graph.constraints()) {
    if (constraint.may_be_wrong && std::abs(constraint.to - constraint.from) > 1)
      drawing.add_line("loops", {way[constraint.from], way[constraint.to]}, kLoop_m, kLoopColor,
                       false);
  }
}

}  // namespace mocha
