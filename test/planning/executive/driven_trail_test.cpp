#include "planning/executive/driven_trail.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

RobotState at(double x, double speed) {
  RobotState state;
  state.pose.position = {x, 0.0};
  state.twist.speed = speed;
  return state;
}

TEST(DrivenTrail, GrowsByTheDecimetreNewestLast) {
  DrivenTrail trail;
  for (int i = 0; i <= 100; ++i) trail.add(at(0.01 * i, 0.5));
  ASSERT_GE(trail.points().size(), 9u);
  EXPECT_LE(trail.points().size(), 11u);
  EXPECT_EQ(trail.points().front().x(), 0.0);
  for (std::size_t i = 1; i < trail.points().size(); ++i) {
    EXPECT_GE((trail.points()[i] - trail.points()[i - 1]).norm(), 0.1 - 1e-9);
  }
  EXPECT_GT(trail.points().back().x(), 0.85);
}

TEST(DrivenTrail, IsTakenBackWhileBackingOut) {
  DrivenTrail trail;
  for (int i = 0; i <= 100; ++i) trail.add(at(0.01 * i, 0.5));
  for (int i = 100; i >= 50; --i) trail.add(at(0.01 * i, -0.3));
  ASSERT_FALSE(trail.points().empty());
  EXPECT_LE(trail.points().back().x(), 0.5);
  EXPECT_EQ(trail.points().front().x(), 0.0);
  for (int i = 50; i >= 0; --i) trail.add(at(0.01 * i, -0.3));
  EXPECT_TRUE(trail.points().empty());
}

TEST(DrivenTrail, StandingAddsNothing) {
  DrivenTrail trail;
  for (int i = 0; i < 1000; ++i) trail.add(at(1.0 + 0.001 * (i % 2), 0.0));
  EXPECT_EQ(trail.points().size(), 1u);
}

TEST(DrivenTrail, NoiseOfAStandingRobotTakesNothingBack) {
  DrivenTrail trail;
  for (int i = 0; i <= 100; ++i) trail.add(at(0.01 * i, 0.5));
  const std::size_t size = trail.points().size();
  for (int i = 0; i < 100; ++i) trail.add(at(1.0, i % 2 ? 0.002 : -0.002));
  EXPECT_GE(trail.points().size() + 1, size);
}

TEST(DrivenTrail, ForgetsWhatIsLongAgo) {
  DrivenTrail trail;
  for (int i = 0; i <= 10000; ++i) trail.add(at(0.01 * i, 0.5));
  EXPECT_LE(trail.points().size(), 200u);
  EXPECT_GT(trail.points().size(), 150u);
  EXPECT_GT(trail.points().back().x(), 99.0);
}

}  // namespace
}  // namespace mocha
