#include "planning/executive/yield_asking.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

constexpr double kStep_s = 0.05;

/// A robot that stands or not before a team-mate, for so long; how often it asked.
struct Scene {
  YieldAsking asking;
  double now_s = 1.7e9;

  int run(double time_s, bool rests, bool on_it, bool near_it) {
    int asked = 0;
    for (const double end_s = now_s + time_s - 1e-6; now_s < end_s;) {
      now_s += kStep_s;
      if (asking.due(now_s, rests)) asked += asking.look(now_s, on_it, near_it);
    }
    return asked;
  }
};

TEST(YieldAsking, AsksAfterAWhileOfStandingBeforeSomebodyAndThenAgain) {
  Scene scene;
  EXPECT_EQ(scene.run(1.4, true, true, true), 0);
  EXPECT_EQ(scene.run(0.3, true, true, true), 1);
  EXPECT_NEAR(scene.run(4.0, true, true, true), 8, 1);
  EXPECT_NEAR(scene.run(4.0, false, true, true), 8, 1);  // on its way, a team-mate still on it
}

TEST(YieldAsking, AsksNobodyWhoIsNotThere) {
  Scene scene;
  EXPECT_EQ(scene.run(10.0, true, false, true), 0);
  EXPECT_FALSE(scene.asking.take_withdrawal());
}

TEST(YieldAsking, DrivingIsNotStanding) {
  Scene scene;
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(scene.run(1.2, true, true, true), 0);
    EXPECT_EQ(scene.run(0.1, false, true, true), 0);
  }
}

TEST(YieldAsking, EndsAWhileAfterTheLastIsPassed) {
  Scene scene;
  scene.run(3.0, true, true, true);
  EXPECT_GT(scene.run(2.4, false, false, false), 3);
  EXPECT_FALSE(scene.asking.take_withdrawal());
  scene.run(1.2, false, false, false);
  EXPECT_FALSE(scene.asking.asks());
  EXPECT_TRUE(scene.asking.take_withdrawal());
  EXPECT_FALSE(scene.asking.take_withdrawal());
  EXPECT_EQ(scene.run(5.0, false, true, true), 0);
}

TEST(YieldAsking, WhoIsNearKeepsItUp) {
  Scene scene;
  scene.run(3.0, true, true, true);
  scene.run(20.0, false, false, true);
  EXPECT_TRUE(scene.asking.asks());
}

TEST(YieldAsking, BeginsAnewWithAnotherPath) {
  Scene scene;
  scene.run(3.0, true, true, true);
  scene.asking.stop();
  EXPECT_TRUE(scene.asking.take_withdrawal());
  EXPECT_EQ(scene.run(1.4, true, true, true), 0);
  EXPECT_EQ(scene.run(0.3, true, true, true), 1);
}

}  // namespace
}  // namespace mocha
