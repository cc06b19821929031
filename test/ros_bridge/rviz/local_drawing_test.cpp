#include "ros_bridge/rviz/local_drawing.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"

namespace mocha {
namespace {

using visualization_msgs::Marker;

PlanCandidate candidate(double y) {
  PlanCandidate result;
  result.path = {{0.0, 0.0}, {2.0, y}, {4.0, 0.0}};
  return result;
}

/// Two paths, the second chosen; the motion goes on beyond the rejoin point.
LocalPlan swerve() {
  LocalPlan plan;
  plan.reason = PlanReason::kSolved;
  plan.candidates = {candidate(1.0), candidate(-1.0)};
  PlanCandidate& chosen = plan.candidates[1];
  chosen.selected = true;
  chosen.reason = PlanReason::kSolved;
  chosen.motion = straight_drive(10.0, {0.0, 0.0}, 0.0, 8.0, 1.0, 1.0);
  chosen.drive_ends_s = 14.5;  // half of it
  plan.motion = chosen.motion;
  plan.rejoins_s = chosen.drive_ends_s;
  plan.rejoin_point.state.col(0) << 4.0, 0.0;
  return plan;
}

std::vector<Marker> named(const LocalPlan& plan, const std::string& name) {
  Drawing drawing("map", ros::Time(1.0));
  draw_local_plan(plan, drawing);
  std::vector<Marker> found;
  for (const Marker& marker : drawing.markers().markers) {
    if (marker.ns == name) found.push_back(marker);
  }
  return found;
}

TEST(LocalDrawing, EveryPathIsThinAndDashedInItsOwnColour) {
  const auto paths = named(swerve(), "local paths");
  ASSERT_EQ(paths.size(), 2u);
  EXPECT_EQ(paths[0].type, Marker::LINE_LIST);
  EXPECT_EQ(paths[1].type, Marker::LINE_LIST);
  EXPECT_GT(paths[0].points.size(), 10u);
  EXPECT_EQ(paths[0].points.size() % 2, 0u);
  EXPECT_NE(paths[0].color.r, paths[1].color.r);
}

TEST(LocalDrawing, TheChosenDetourIsBroadAndEndsAtTheRejoinPoint) {
  const auto lines = named(swerve(), "detour");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].type, Marker::LINE_STRIP);
  EXPECT_GT(lines[0].scale.x, named(swerve(), "local paths")[0].scale.x);
  EXPECT_EQ(lines[0].color.r, named(swerve(), "local paths")[1].color.r);
  EXPECT_NEAR(lines[0].points.front().x, 0.0, 1e-9);
  EXPECT_NEAR(lines[0].points.back().x, 4.0, 1e-6);
}

TEST(LocalDrawing, TheRejoinPointIsARedSquare) {
  const auto squares = named(swerve(), "rejoin point");
  ASSERT_EQ(squares.size(), 1u);
  EXPECT_EQ(squares[0].type, Marker::CUBE);
  EXPECT_EQ(squares[0].pose.position.x, 4.0);
  EXPECT_GT(squares[0].color.r, 3.0F * squares[0].color.g);
}

TEST(LocalDrawing, WithoutADetourThereAreOnlyThePathsThatWereTried) {
  LocalPlan plan;
  plan.candidates = {candidate(1.0)};
  EXPECT_EQ(named(plan, "local paths").size(), 1u);
  EXPECT_TRUE(named(plan, "detour").empty());
  EXPECT_TRUE(named(plan, "rejoin point").empty());
  EXPECT_TRUE(named(LocalPlan(), "local paths").empty());
}

}  // namespace
}  // namespace mocha
