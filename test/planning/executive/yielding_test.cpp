#include "planning/executive/yielding.h"

#include <gtest/gtest.h>

#include "planning/candidates/peer_discs.h"
#include "planning/worlds.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;

/// ugv5, a rover, on a corridor for one along x from 0 to 8 m with a room at either end, and a bay
/// at x = 3 to 5 m above it.
class YieldingTest : public ::testing::Test {
 protected:
  YieldingTest() : right_({false, 0, "ugv5"}, rover(), default_options()) {
    OccupancyGrid grid = free_grid({-4.0, -2.0}, {12.0, 2.0});
    fill_box(grid, {0.0, -2.0}, {8.0, -0.55});
    fill_box(grid, {0.0, 0.55}, {3.0, 2.0});
    fill_box(grid, {5.0, 0.55}, {8.0, 2.0});
    scene_.static_map = static_map_of(grid);
  }

  static YieldRequest asked(const std::string& agent, std::vector<Vector2> path) {
    return {agent, 1, {false, 0, agent}, 0.3, 1.0, std::move(path)};
  }
  /// From the left room through the corridor into the right one.
  static std::vector<Vector2> through() { return {{-2.0, 0.0}, {10.0, 0.0}}; }

  void stand(const std::string& name, const Vector2& place) {
    scene_.peers.push_back(std::make_shared<PeerObstacle>(
        name, std::make_shared<const Motion>(standing(kNow_s - 5.0, place, 0.0)), 0.3,
        test::kRoverBraking));
  }

  const double keep_m_ = 0.3 + distance_to_peers_m(rover());
  Yielding right_;
  PlanningScene scene_;
};

TEST_F(YieldingTest, YieldsToTheHigherRankOnlyWhileItAsks) {
  const Vector2 here(2.0, 0.0);
  EXPECT_FALSE(right_.in_way_of(here, kNow_s));
  right_.hear(asked("ugv7", through()), kNow_s);
  EXPECT_FALSE(right_.yields(kNow_s));
  right_.hear(asked("ugv2", through()), kNow_s);
  ASSERT_TRUE(right_.in_way_of(here, kNow_s));
  EXPECT_EQ(right_.in_way_of(here, kNow_s)->agent, "ugv2");
  EXPECT_TRUE(right_.yields(kNow_s + 1.9));
  EXPECT_FALSE(right_.yields(kNow_s + 2.1));  // lapsed
  right_.hear(asked("ugv2", through()), kNow_s + 3.0);
  right_.hear(asked("ugv2", {}), kNow_s + 3.1);
  EXPECT_FALSE(right_.yields(kNow_s + 3.1));  // withdrawn
}

TEST_F(YieldingTest, OneWhoAsksInTheNameOfAHigherOneIsHigher) {
  YieldRequest request = asked("ugv7", through());
  request.rank.agent = "ugv1";
  right_.hear(request, kNow_s);
  ASSERT_TRUE(right_.in_way_of(Vector2(2.0, 0.0), kNow_s));
  EXPECT_EQ(right_.in_way_of(Vector2(2.0, 0.0), kNow_s)->agent, "ugv1");
}

TEST_F(YieldingTest, WhoIsStuckYieldsToNobodyButToOneWhoIsToo) {
  right_.hear(asked("ugv2", through()), kNow_s);
  right_.set_stuck(true);
  EXPECT_FALSE(right_.yields(kNow_s));
  YieldRequest stuck = asked("ugv3", through());
  stuck.rank.stuck = true;
  right_.hear(stuck, kNow_s);
  EXPECT_TRUE(right_.yields(kNow_s));
}

TEST_F(YieldingTest, WhoIsParkedYieldsToAll) {
  right_.hear(asked("ugv7", through()), kNow_s);
  right_.set_parked(true);
  EXPECT_TRUE(right_.yields(kNow_s));
  right_.set_parked(false);
  EXPECT_FALSE(right_.yields(kNow_s));
}

TEST_F(YieldingTest, HearsNothingInItsOwnName) {
  YieldRequest own = asked("ugv5", through());
  own.rank.stuck = true;
  right_.hear(own, kNow_s);
  EXPECT_FALSE(right_.yields(kNow_s));
}

TEST_F(YieldingTest, IsInTheWayWhereTheOtherCouldNotPass) {
  right_.hear(asked("ugv2", {{-2.0, 0.0}, {1.0, 0.0}, {1.0, 10.0}}), kNow_s);
  EXPECT_TRUE(right_.in_way_of(Vector2(0.0, -keep_m_ + 0.01), kNow_s));
  EXPECT_FALSE(right_.in_way_of(Vector2(0.0, -keep_m_ - 0.01), kNow_s));
  EXPECT_FALSE(right_.in_way_of(Vector2(-2.0 - keep_m_ - 0.01, 0.0), kNow_s));
}

TEST_F(YieldingTest, WhoIsGoneBeforeTheOtherCanComeIsNotInItsWay) {
  // The other drives up along x = 0 and needs 10 s to here at its fastest.
  right_.hear(asked("ugv2", {{0.0, -10.0}, {0.0, 10.0}}), kNow_s);
  const auto crossing = [](double start_s) {
    return straight_drive(start_s, {-3.0, 0.0}, 0.0, 6.0, 1.0, 1.0);
  };
  EXPECT_FALSE(right_.in_way_of(crossing(kNow_s), kNow_s));
  EXPECT_TRUE(right_.in_way_of(crossing(kNow_s + 5.5), kNow_s));
  // It will stand there.
  EXPECT_TRUE(right_.in_way_of(straight_drive(kNow_s, {-3.0, 0.0}, 0.0, 2.5, 1.0, 1.0), kNow_s));
}

TEST_F(YieldingTest, DrivingTowardsEachOtherIsMeeting) {
  right_.hear(asked("ugv2", {{8.0, 0.0}, {-10.0, 0.0}}), kNow_s);
  EXPECT_TRUE(right_.in_way_of(straight_drive(kNow_s, {-3.0, 0.0}, 0.0, 20.0, 1.0, 1.0), kNow_s));
  // Away from it and out of its way in time.
  EXPECT_FALSE(
      right_.in_way_of(straight_drive(kNow_s, {0.0, 0.0}, M_PI / 2.0, 3.0, 1.0, 1.0), kNow_s));
}

TEST_F(YieldingTest, TheNearestPullOverPointIsInTheBay) {
  right_.hear(asked("ugv2", through()), kNow_s);
  const auto place = right_.pull_over_point({5.5, 0.0}, scene_, kNow_s);
  ASSERT_TRUE(place);
  EXPECT_GT(place->y(), keep_m_);
  EXPECT_GT(place->x(), 3.0);
  EXPECT_LT(place->x(), 5.0);
  EXPECT_FALSE(right_.in_way_of(*place, kNow_s));
}

TEST_F(YieldingTest, WhoAsksIsNotPassedOnTheWayToThePullOverPoint) {
  stand("ugv2", {5.6, 0.0});
  right_.hear(asked("ugv2", {{5.6, 0.0}, {10.0, 0.0}}), kNow_s);
  EXPECT_GT(right_.pull_over_point({6.6, 0.0}, scene_, kNow_s)->x(), 8.0);
}

TEST_F(YieldingTest, WhoMerelyStandsIsDrivenAroundOrElseAsked) {
  right_.hear(asked("ugv2", through()), kNow_s);
  stand("ugv8", {4.0, 1.2});  // in the bay
  const auto beside = right_.pull_over_point({5.5, 0.0}, scene_, kNow_s);
  ASSERT_TRUE(beside);
  EXPECT_GT(beside->x(), 8.0);
  stand("ugv9", {6.8, 0.0});  // and behind
  EXPECT_TRUE(right_.pull_over_point({5.5, 0.0}, scene_, kNow_s));
}

TEST_F(YieldingTest, InADeadEndThereIsNoPullOverPoint) {
  OccupancyGrid grid = free_grid({-4.0, -2.0}, {8.0, 2.0});
  fill_box(grid, {0.0, -2.0}, {8.0, -0.55});
  fill_box(grid, {0.0, 0.55}, {8.0, 2.0});
  scene_.static_map = static_map_of(grid);
  stand("ugv2", {4.0, 0.0});
  right_.hear(asked("ugv2", {{4.0, 0.0}, {7.0, 0.0}}), kNow_s);
  EXPECT_FALSE(right_.pull_over_point({6.0, 0.0}, scene_, kNow_s));
  scene_.peers.clear();  // it went away
  EXPECT_LT(right_.pull_over_point({6.0, 0.0}, scene_, kNow_s)->x(), 3.5);
}

TEST_F(YieldingTest, WhereNotAllCanBeSparedTheHighestIs) {
  std::vector<Vector2> everywhere;
  for (double x = -3.8; x < 12.0; x += 0.5) {
    everywhere.emplace_back(x, -2.0);
    everywhere.emplace_back(x, 2.0);
    everywhere.emplace_back(x + 0.25, 2.0);
    everywhere.emplace_back(x + 0.25, -2.0);
  }
  right_.hear(asked("ugv2", through()), kNow_s);
  right_.hear(asked("ugv3", everywhere), kNow_s);
  const Vector2 place = *right_.pull_over_point({5.5, 0.0}, scene_, kNow_s);
  EXPECT_EQ(right_.in_way_of(place, kNow_s)->agent, "ugv3");
  EXPECT_GT(std::abs(place.y()), keep_m_);
}

TEST_F(YieldingTest, AsksForTheWayOnTheMapWhoeverStandsThere) {
  stand("ugv8", {4.0, 0.0});
  const auto path = right_.path({-2.0, 0.0}, {10.0, 0.0}, scene_);
  ASSERT_GE(path.size(), 2u);
  EXPECT_TRUE(right_.is_near(path, scene_, kNow_s, 0.0));
  const YieldRequest request = right_.request_for(path, right_.own());
  EXPECT_NO_THROW(validate(request));
  EXPECT_EQ(request.agent, "ugv5");
  EXPECT_EQ(request.rank.agent, "ugv5");
  scene_.peers.clear();
  stand("ugv8", {4.0, keep_m_ + 0.5});
  EXPECT_FALSE(right_.is_near(path, scene_, kNow_s, 0.0));
  EXPECT_TRUE(right_.is_near(path, scene_, kNow_s, 1.0));
}

TEST_F(YieldingTest, AFloodOfNamesDoesNotSilenceWhoWasHeardBefore) {
  right_.hear(asked("ugv2", {{50.0, 0.0}, {60.0, 0.0}}), kNow_s);
  for (int i = 0; i < 2000; ++i)
    right_.hear(asked("a" + std::to_string(i), {{50.0, 0.0}, {60.0, 0.0}}), kNow_s);
  right_.hear(asked("ugv2", through()), kNow_s + 1.0);
  EXPECT_TRUE(right_.in_way_of(Vector2(2.0, 0.0), kNow_s + 1.0));
}

TEST_F(YieldingTest, AFloodOfNamesTakesNoMoreMemory) {
  for (int i = 0; i < 2000; ++i)
    right_.hear(asked("a" + std::to_string(i), {{50.0, 0.0}, {60.0, 0.0}}), kNow_s);
  right_.hear(asked("a0", through()), kNow_s + 2.5);  // the others have lapsed
  EXPECT_TRUE(right_.in_way_of(Vector2(2.0, 0.0), kNow_s + 2.5));
}

}  // namespace
}  // namespace mocha
