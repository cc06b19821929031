#include "ros_bridge/rviz/zone_drawing.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace mocha {
namespace {

using visualization_msgs::Marker;

const Polygon kSquare{{{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}}};

std::map<std::string, Marker> drawn(const Zones& zones, const std::vector<Vector2>& exit) {
  Drawing drawing("map", ros::Time(1.0));
  draw_zones(zones, exit, drawing);
  std::map<std::string, Marker> markers;
  for (const Marker& marker : drawing.markers().markers) {
    if (marker.action == Marker::ADD) markers[marker.ns + " " + marker.text] = marker;
  }
  return markers;
}

TEST(ZoneDrawing, OutlinesAreClosedAndNamed) {
  auto markers = drawn({{"stairs", kSquare, 0.0}, {"school", kSquare, 0.3}}, {});
  ASSERT_EQ(markers.size(), 4u);
  EXPECT_EQ(markers.count("names of zones stairs"), 1u);
  EXPECT_EQ(markers.at("names of zones school: 0.3 m/s").pose.position.x, 1.0);
  const Marker& outline = markers.at("keep-out zones ");
  ASSERT_EQ(outline.points.size(), 5u);
  EXPECT_EQ(outline.points.front(), outline.points.back());
  EXPECT_NE(outline.color, markers.at("speed zones ").color);
}

TEST(ZoneDrawing, TheWayOutIsDrawn) {
  EXPECT_EQ(drawn({{"stairs", kSquare, 0.0}}, {{1.0, 1.0}, {3.0, 1.0}}).count("way out "), 1u);
  EXPECT_TRUE(drawn({}, {}).empty());
}

}  // namespace
}  // namespace mocha
