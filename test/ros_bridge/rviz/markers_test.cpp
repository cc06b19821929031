#include "ros_bridge/rviz/markers.h"

#include <gtest/gtest.h>

#include <optional>
#include <set>
#include <utility>

#include "trajectory/minco.h"

namespace mocha {
namespace {

using visualization_msgs::Marker;

/// 2 m straight ahead from rest to rest in 4 s, then half a turn.
Motion there_and_turn() {
  PlanarMinco minco;
  minco.resize(1);
  PlanarMinco::State end = PlanarMinco::State::Zero();
  end(0, 0) = 2.0;
  minco.solve(PlanarMinco::State::Zero(), end, PlanarMinco::Knots(2, 0),
              Eigen::VectorXd::Constant(1, 4.0));
  return Motion(10.0, {DrivePhase{1, minco.curve()}, TurnPhase{{{2.0, 0.0}, 0.0}, 3.0, 2.0}});
}

TEST(Markers, PathHasPosesAndTimes) {
  const nav_msgs::Path path = to_path(there_and_turn(), "map", 0.1);
  ASSERT_EQ(path.poses.size(), 61u);
  EXPECT_EQ(path.header.frame_id, "map");
  EXPECT_NEAR(path.poses.front().header.stamp.toSec(), 10.0, 1e-6);
  EXPECT_NEAR(path.poses.back().header.stamp.toSec(), 16.0, 1e-6);
  EXPECT_NEAR(path.poses.back().pose.position.x, 2.0, 1e-6);
  EXPECT_NEAR(path.poses.back().pose.orientation.z, std::sin(1.5), 1e-6);
  EXPECT_TRUE(to_path(Motion(), "map", 0.1).poses.empty());
}

TEST(Markers, PolylineHoldsTheDrivesOnly) {
  const auto points = polyline(there_and_turn(), 0.1);
  EXPECT_EQ(points.size(), 41u);
  EXPECT_NEAR(points.back().x(), 2.0, 1e-9);
}

TEST(Markers, LineIsBlueAtRestAndRedAtFullSpeed) {
  Drawing drawing("map", ros::Time(1.0));
  drawing.add_motion("ugv1", there_and_turn(), 1.875 * 2.0 / 4.0);
  const Marker& line = drawing.markers().markers.back();
  ASSERT_EQ(line.type, Marker::LINE_STRIP);
  ASSERT_EQ(line.colors.size(), line.points.size());
  EXPECT_EQ(line.colors.front().b, 1.0f);
  EXPECT_EQ(line.colors.front().r, 0.0f);
  const auto& middle = line.colors[40];  // t = 2 s
  EXPECT_EQ(middle.r, 1.0f);
  EXPECT_NEAR(middle.g, 0.0, 1e-3);
  EXPECT_EQ(middle.b, 0.0f);
}

TEST(Markers, DrawingReplacesTheLastAndNumbersUniquely) {
  Drawing drawing("map", ros::Time(1.0));
  const Motion motion = there_and_turn();
  drawing.add_motion("committed", motion, 1.0);
  drawing.add_line("line", {{0.0, 0.0}, {1.0, 0.0}, {2.0, 1.0}}, 0.1, color(1.0, 0.0, 0.0), true);
  drawing.add_label("line", "12.3", {1.0, 2.0}, 0.3, color(1.0, 0.0, 0.0));
  drawing.add_robot("ugv1", "ugv1/base_link", Footprint::rectangle(0.5, 0.4));
  drawing.add_goal("goal", {3.0, 4.0}, 1.0);
  drawing.add_obstacle(PredictedDisc("person", 0.0, {1.0, 0.0}, {0.5, 0.0}, 0.3, 0.1), 0.0, 2.0);
  const auto& markers = drawing.markers().markers;
  EXPECT_EQ(markers.front().action, Marker::DELETEALL);
  std::set<std::pair<std::string, int>> ids;
  for (std::size_t i = 1; i < markers.size(); ++i) {
    EXPECT_TRUE(ids.insert({markers[i].ns, markers[i].id}).second)
        << markers[i].ns << markers[i].id;
    EXPECT_GT(markers[i].color.a, 0.0f);
    EXPECT_EQ(markers[i].pose.orientation.w * markers[i].pose.orientation.w +
                  markers[i].pose.orientation.z * markers[i].pose.orientation.z,
              1.0);
  }
  EXPECT_EQ(markers[3].points.size(), 2u);  // a dash has two ends
  EXPECT_EQ(markers[4].text, "12.3");
}

TEST(Markers, GoalShowsAHeadingOnlyWhereOneIsAskedFor) {
  const auto arrows = [](std::optional<double> yaw_rad) {
    Drawing drawing("map", ros::Time(1.0));
    drawing.add_goal("ugv1", {3.0, 4.0}, yaw_rad);
    int count = 0;
    for (const Marker& marker : drawing.markers().markers) count += marker.type == Marker::ARROW;
    return count;
  };
  // The first marker of a drawing, DELETEALL, has type 0 as well: ARROW.
  EXPECT_EQ(arrows(std::nullopt), 1);
  EXPECT_EQ(arrows(0.5), 2);
}

TEST(Markers, RobotIsFixedToItsFrameAndClosed) {
  Drawing drawing("map", ros::Time(1.0));
  drawing.add_robot("ugv1", "ugv1/base_link", Footprint::disc(0.3));
  const auto& markers = drawing.markers().markers;
  const Marker& line = markers[1];
  EXPECT_EQ(line.header.frame_id, "ugv1/base_link");
  EXPECT_TRUE(line.header.stamp.isZero());
  EXPECT_EQ(line.points.front(), line.points.back());
  EXPECT_EQ(markers.back().text, "ugv1");
}

TEST(Markers, WhatIsToComeDoesNotHideWhatIsNow) {
  Drawing drawing("map", ros::Time(1.0));
  drawing.add_obstacle(PredictedDisc("person", 0.0, {1.0, 0.0}, {0.0, 0.0}, 0.3, 0.1), 0.0, 5.0);
  const auto& markers = drawing.markers().markers;
  double seen_through = 1.0;  // of what is below all discs but the first
  for (std::size_t i = 2; i < markers.size(); ++i) seen_through *= 1.0 - markers[i].color.a;
  EXPECT_LT(1.0 - seen_through, markers[1].color.a);
}

TEST(Markers, ObstacleFadesAndGrows) {
  Drawing drawing("map", ros::Time(1.0));
  drawing.add_obstacle(PredictedDisc("person", 0.0, {1.0, 0.0}, {0.5, 0.0}, 0.3, 0.1), 0.0, 2.0);
  const auto& markers = drawing.markers().markers;
  ASSERT_EQ(markers.size(), 4u);
  for (std::size_t i = 2; i < markers.size(); ++i) {
    EXPECT_LT(markers[i].color.a, markers[i - 1].color.a);
    EXPECT_GT(markers[i].scale.x, markers[i - 1].scale.x);
    EXPECT_GT(markers[i].pose.position.x, markers[i - 1].pose.position.x);
  }
}

}  // namespace
}  // namespace mocha
