#include "planning/executive/impediment_watch.h"

#include <gtest/gtest.h>

#include "planning/candidates/peer_discs.h"
#include "planning/global/front_end.h"
#include "planning/worlds.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

constexpr double kStep_s = 0.05;

/// A robot at the origin that is to get along a corridor for one to x = 8 m.
class ImpedimentWatchTest : public ::testing::Test {
 protected:
  ImpedimentWatchTest() {
    OccupancyGrid grid = free_grid({-3.0, -3.0}, {11.0, 3.0});
    fill_box(grid, {1.0, 0.6}, {7.0, 3.0});
    fill_box(grid, {1.0, -3.0}, {7.0, -0.6});
    scene_.static_map = static_map_of(grid);
  }

  void stand_at(const Vector2& place) {
    scene_.peers = {std::make_shared<PeerObstacle>(
        "ugv7", std::make_shared<const Motion>(standing(now_s_ - 5.0, place, 0.0)), 0.3,
        test::kRoverBraking)};
  }

  /// How often it is impeded in so many seconds.
  int run(double time_s, bool stands = true) {
    int impeded = 0;
    for (const double end_s = now_s_ + time_s - 1e-6; now_s_ < end_s;) {
      now_s_ += kStep_s;
      impeded += watch_.is_impeded(stands, {0.0, 0.0}, goal_, scene_, rover(), travel_, now_s_);
    }
    return impeded;
  }

  double now_s_ = 1.7e9;
  Vector2 goal_{8.0, 0.0};
  PlanningScene scene_;
  const TravelOptions travel_ = homotopy_path_options(rover(), default_options()).travel;
  ImpedimentWatch watch_;
};

TEST_F(ImpedimentWatchTest, ARobotIsImpededOnceItHasStoodForAWhileWithATeamMateOnItsWay) {
  stand_at({4.0, 0.0});
  EXPECT_EQ(run(0.9), 0);
  EXPECT_GT(run(0.2), 0);
  EXPECT_NEAR(run(2.0), 40, 1);
}

/// It will soon drive there.
TEST_F(ImpedimentWatchTest, WhereThereIsAnotherWayItIsMorePatient) {
  goal_ = {0.0, -2.5};
  stand_at({0.0, -1.2});
  EXPECT_EQ(run(3.9), 0);
  EXPECT_GT(run(0.6), 0);
  EXPECT_GT(run(1.0), 0);
  run(0.5, false);
  EXPECT_EQ(run(2.0, false), 0) << "it has found it";
}

TEST_F(ImpedimentWatchTest, NobodyIsImpededByWhoIsElsewhere) {
  run(5.0);
  EXPECT_EQ(run(5.0), 0);
  stand_at({-2.0, 0.0});
  EXPECT_EQ(run(5.0), 0);
}

/// On the way is who keeps the robot's centre from it.
TEST_F(ImpedimentWatchTest, BesideTheWayIsFarEnoughWhereItCanPass) {
  goal_ = {0.0, -2.5};
  const BlockedDisc disc = peer_keep_out(
      PeerObstacle("ugv7", std::make_shared<const Motion>(standing(0.0, {0.0, 0.0}, 0.0)), 0.3,
                   test::kRoverBraking),
      1.0, rover(), 0.0);
  stand_at({disc.radius_m + 0.06, -1.2});
  EXPECT_EQ(run(6.0), 0);
  stand_at({disc.radius_m - 0.06, -1.2});
  EXPECT_GT(run(1.0), 0);
}

TEST_F(ImpedimentWatchTest, DrivingIsNotStanding) {
  stand_at({4.0, 0.0});
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(run(0.8), 0);
    EXPECT_EQ(run(0.1, false), 0);
  }
}

TEST_F(ImpedimentWatchTest, WhoMovesOnALittleStaysImpededUntilTheWayIsFree) {
  stand_at({4.0, 0.0});
  ASSERT_GT(run(3.0), 0);
  EXPECT_GT(run(0.5, false), 0);
  stand_at({4.0, 2.9});
  run(0.5, false);
  EXPECT_EQ(run(0.5, false), 0);
  EXPECT_EQ(run(0.9), 0);
}

TEST_F(ImpedimentWatchTest, ATeamMateOnTheGoalIsOnTheWay) {
  stand_at(goal_);
  EXPECT_GT(run(3.0), 0);
}

TEST_F(ImpedimentWatchTest, WhereNoWayLeadsNobodyIsOnIt) {
  OccupancyGrid grid = free_grid({-3.0, -3.0}, {11.0, 3.0});
  fill_box(grid, {1.0, -3.0}, {7.0, 3.0});
  scene_.static_map = static_map_of(grid);
  stand_at({0.5, 0.0});
  EXPECT_EQ(run(5.0), 0);
}

TEST_F(ImpedimentWatchTest, SeesSoonWhenTheWayIsClear) {
  stand_at({4.0, 0.0});
  run(3.0);
  scene_.peers.clear();
  run(0.5);
  EXPECT_EQ(run(1.0), 0);
}

TEST_F(ImpedimentWatchTest, BeginsAnewWithAnotherWay) {
  stand_at({4.0, 0.0});
  run(3.0);
  watch_.reset();
  EXPECT_EQ(run(0.9), 0);
  EXPECT_GT(run(0.3), 0);
}

/// A search for a way takes a while.
TEST_F(ImpedimentWatchTest, LooksTwiceASecondAtMost) {
  stand_at({4.0, 0.0});
  while (run(kStep_s) == 0) ASSERT_LT(now_s_, 1.7e9 + 2.0);
  stand_at({4.0, 2.0});  // in the wall; what it saw counts until it looks again
  EXPECT_EQ(run(0.4), 8);
  run(0.2);
  EXPECT_EQ(run(0.5), 0);
}

}  // namespace
}  // namespace mocha
