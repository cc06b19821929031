#include "planning/candidates/start_maneuver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planning/worlds.h"

namespace mocha {
namespace {

constexpr double kSmoothStart_rad = 0.8;
const MotionLimits kLimits = rover().limits;
const StartManeuvers kStartManeuvers(kLimits, kSmoothStart_rad);
const Pose kAhead{{1.0, 2.0}, 0.0};

/// Straight from where the robot is.
std::vector<Vector2> path_towards(double yaw_rad) {
  return {kAhead.position, kAhead.position + 3.0 * Vector2(std::cos(yaw_rad), std::sin(yaw_rad))};
}

TEST(StartManeuvers, BeginAtOnceWhereThePathLiesAhead) {
  const auto found = kStartManeuvers.from_rest({}, kAhead, path_towards(0.0));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].phases.empty());
  EXPECT_EQ(found[0].duration_s, 0.0);
  EXPECT_EQ(found[0].state.col(0), kAhead.position);
  EXPECT_TRUE(found[0].state.col(1).isZero());
  EXPECT_NEAR(found[0].state(0, 2), rest_acceleration(kLimits), 1e-12);
}

TEST(StartManeuvers, RatherDriveABendThanTurnFirst) {
  const auto found = kStartManeuvers.from_rest({}, kAhead, path_towards(0.5));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_TRUE(found[0].phases.empty());
  EXPECT_EQ(found[1].phases.size(), 1u);
}

TEST(StartManeuvers, TurnInPlaceWhereThePathLiesAside) {
  const Phase before = StandPhase{kAhead, 0.4};
  for (const double yaw_rad : {-2.5, -1.0, 1.0, 3.0}) {
    const auto found = kStartManeuvers.from_rest({before}, kAhead, path_towards(yaw_rad));
    ASSERT_EQ(found.size(), 1u) << yaw_rad;
    ASSERT_EQ(found[0].phases.size(), 2u);
    EXPECT_NEAR(std::get<TurnPhase>(found[0].phases[1]).yaw_change_rad, yaw_rad, 1e-9);
    EXPECT_NEAR(found[0].duration_s, 0.4 + duration_s(found[0].phases[1]), 1e-12);
    const Vector2 along = found[0].state.col(2);
    EXPECT_NEAR(std::atan2(along.y(), along.x()), yaw_rad, 1e-9) << "it drives off as it stands";
  }
}

TEST(StartManeuvers, GoOnOutOfADriveUnlessThePathTurnsAway) {
  const MotionState state = straight_drive(0.0, kAhead.position, 0.0, 4.0, 0.8, 0.5).at(3.0);
  const auto found = kStartManeuvers.rolling(state, path_towards(0.6));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].state.col(1), state.velocity);
  EXPECT_TRUE(found[0].phases.empty());
  EXPECT_TRUE(kStartManeuvers.rolling(state, path_towards(1.5)).empty());
  EXPECT_TRUE(kStartManeuvers.rolling({kAhead}, path_towards(0.0)).empty()) << "it stands";
}

TEST(StartManeuvers, BackwardWhereThatTakesASmallerTurn) {
  const auto straight =
      kStartManeuvers.from_rest({}, kAhead, path_towards(M_PI), Drives::kEitherWay);
  ASSERT_EQ(straight.size(), 2u);
  EXPECT_EQ(straight[0].direction, -1);
  EXPECT_TRUE(straight[0].phases.empty());
  EXPECT_NEAR(straight[0].state(0, 2), -rest_acceleration(kLimits), 1e-12);
  EXPECT_EQ(straight[1].direction, 1) << "where that is not possible";
  const auto aside = kStartManeuvers.from_rest({}, kAhead, path_towards(2.0), Drives::kEitherWay);
  ASSERT_EQ(aside.size(), 2u);
  EXPECT_NEAR(std::get<TurnPhase>(aside[0].phases.at(0)).yaw_change_rad, 2.0 - M_PI, 1e-9);
  const Vector2 along = aside[0].state.col(2);
  EXPECT_NEAR(std::atan2(along.y(), along.x()), 2.0, 1e-9);
  for (const double yaw_rad : {0.0, 1.0, -1.5}) {
    for (const auto& start :
         kStartManeuvers.from_rest({}, kAhead, path_towards(yaw_rad), Drives::kEitherWay))
      EXPECT_EQ(start.direction, 1) << yaw_rad;
  }
}

TEST(StartManeuvers, GoOnBackwardWhereThatIsAllowed) {
  MotionState state = straight_drive(0.0, kAhead.position, M_PI, 4.0, 0.8, 0.5).at(3.0);
  state.pose.yaw_rad = 0.0;
  state.speed = -state.speed;
  const auto found = kStartManeuvers.rolling(state, path_towards(M_PI), Drives::kEitherWay);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].direction, -1);
  EXPECT_TRUE(kStartManeuvers.rolling(state, path_towards(M_PI)).empty());
  EXPECT_TRUE(kStartManeuvers.rolling(state, path_towards(0.0), Drives::kEitherWay).empty());
}

TEST(TurnInPlace, GoesTheShortWayAndLeavesALittleToTheDrive) {
  const auto turn = turn_in_place({{0.0, 0.0}, 3.0}, -3.0, kLimits);
  ASSERT_TRUE(turn);
  EXPECT_NEAR(turn->yaw_change_rad, 2.0 * M_PI - 6.0, 1e-9);
  EXPECT_FALSE(turn_in_place(kAhead, 0.01, kLimits));
}

}  // namespace
}  // namespace mocha
