#include "planning/executive/told_obstacles.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

TEST(ToldObstacles, AreKnownForHalfAMinuteAfterTheyWereToldLast) {
  ToldObstacles told;
  EXPECT_TRUE(told.all(100.0).empty());
  EXPECT_TRUE(told.note({{1.0, 2.0}, {3.0, 4.0}}, 100.0));
  EXPECT_FALSE(told.note({{3.0, 4.02}}, 120.0)) << "as good as the same";
  EXPECT_EQ(told.all(129.9).size(), 2u);
  EXPECT_EQ(told.all(130.0), (std::vector<Vector2>{{3.0, 4.0}}));
  EXPECT_TRUE(told.all(150.0).empty());
  EXPECT_TRUE(told.note({{3.0, 4.0}}, 150.0)) << "anew";
}

TEST(ToldObstacles, ThoseThatThereIsNoRoomForAreNotHeeded) {
  constexpr int kMost = 512;
  ToldObstacles told;
  for (int i = 0; i < kMost; ++i) EXPECT_TRUE(told.note({{1.0 * i, 0.0}}, 0.0));
  EXPECT_FALSE(told.note({{0.0, 1.0}}, 0.1));
  EXPECT_EQ(told.all(0.1).size(), kMost);
  EXPECT_TRUE(told.note({{0.0, 1.0}}, 30.0));
  EXPECT_EQ(told.all(30.0).size(), 1u);
}

}  // namespace
}  // namespace mocha
