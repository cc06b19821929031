#include "rviz_panel/waypoint_drawing.h"

#include <string>

namespace mocha {
namespace {

constexpr double kHeight_m = 0.3;  // above robots
constexpr double kDot_m = 0.18;
constexpr double kLine_m = 0.04;
constexpr double kText_m = 0.3;

visualization_msgs::Marker marker(const nav_msgs::Path& waypoints, int id, int type,
                                  double size_m) {
  visualization_msgs::Marker marker;
  marker.header.frame_id = waypoints.header.frame_id;
  marker.id = id;
  marker.type = type;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = marker.scale.z = size_m;
  marker.color.r = 0.55f;
  marker.color.b = 0.75f;
  marker.color.a = 1.0f;
  return marker;
}

}  // namespace

visualization_msgs::MarkerArray drawing_of(const nav_msgs::Path& waypoints) {
  using visualization_msgs::Marker;
  visualization_msgs::MarkerArray drawing;
  drawing.markers.emplace_back();
  drawing.markers.back().action = Marker::DELETEALL;
  Marker line = marker(waypoints, 0, Marker::LINE_STRIP, kLine_m);
  int number = 0;
  for (const auto& waypoint : waypoints.poses) {
    geometry_msgs::Point place = waypoint.pose.position;
    place.z = kHeight_m;
    line.points.push_back(place);
    Marker dot = marker(waypoints, ++number, Marker::SPHERE, kDot_m);
    dot.pose.position = place;
    Marker label = marker(waypoints, -number, Marker::TEXT_VIEW_FACING, kText_m);
    label.pose.position = place;
    label.pose.position.y += kText_m;
    label.text = std::to_string(number);
    drawing.markers.push_back(dot);
    drawing.markers.push_back(label);
  }
  if (number > 1) drawing.markers.push_back(line);
  return drawing;
}

}  // namespace mocha
