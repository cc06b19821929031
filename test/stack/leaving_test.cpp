// Robots leave where they stand, through the whole stack: some starts of scripts/bench leaving, and
// the oracle, which tells whether a robot can leave at all.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>

#include "benchmarks/leaving_oracle.h"
#include "benchmarks/leaving_run.h"
#include "benchmarks/leaving_scene.h"

namespace mocha {
namespace {

constexpr double kNoseIn_rad = -0.5 * M_PI;
constexpr double kNoseOut_rad = 0.5 * M_PI;

struct Start {
  const char* name;
  const char* model;
  TightKind kind;
  double gap_m;
  double heading_deg;
};

std::ostream& operator<<(std::ostream& out, const Start& start) { return out << start.name; }

World world_of(const Start& start) {
  return leaving_world(leaving_model(start.model),
                       {start.kind, start.gap_m, start.heading_deg * M_PI / 180.0});
}

class Leaving : public ::testing::TestWithParam<Start> {};

TEST_P(Leaving, ArrivesWithoutContact) {
  const World world = world_of(GetParam());
  EXPECT_EQ(leavable(world), Leavable::kYes);
  const LeavingRun run = run_leaving(world, 1);
  EXPECT_TRUE(run.arrived) << run.words;
  EXPECT_FALSE(run.contact);
  EXPECT_TRUE(run.left_s);
  EXPECT_GT(run.clearance_m, 0.0);
}

INSTANTIATE_TEST_SUITE_P(
    Starts, Leaving,
    ::testing::Values(Start{"JackalNoseToAWall", "jackal", TightKind::kWall, 0.3, 270.0},
                      Start{"JackalAlongAWall", "jackal", TightKind::kWall, 0.15, 0.0},
                      Start{"RoverAlongAWall", "waveshare_rover", TightKind::kWall, 0.2, 0.0},
                      Start{"RoverAslantToAWall", "waveshare_rover", TightKind::kWall, 0.05, 240.0},
                      Start{"RoverInACorner", "waveshare_rover", TightKind::kCorner, 0.05, 60.0},
                      Start{"OwnBodyInACorner", "own", TightKind::kCorner, 0.1, 270.0},
                      Start{"JackalInACorner", "jackal", TightKind::kCorner, 0.05, 270.0},
                      Start{"JackalNoseIn", "jackal", TightKind::kDeadEnd, 0.05, 270.0},
                      Start{"JackalNoseOut", "jackal", TightKind::kDeadEnd, 0.05, 90.0}),
    [](const auto& start) { return start.param.name; });

TEST(LeavingRun, IsTheSameWithTheSameSeed) {
  const World world = world_of({"", "jackal", TightKind::kWall, 0.1, 60.0});
  const LeavingRun once = run_leaving(world, 3);
  const LeavingRun again = run_leaving(world, 3);
  EXPECT_EQ(once.took_s, again.took_s);
  EXPECT_EQ(once.clearance_m, again.clearance_m);
}

// The noise of the lidar would let the wall look nearer or farther by a cell.
TEST(LeavingRun, SucceedsInSpiteOfNoise) {
  const World world = world_of({"", "waveshare_rover", TightKind::kWall, 0.05, 0.0});
  for (const std::uint64_t seed : {3, 4, 5, 6}) {
    const LeavingRun run = run_leaving(world, seed);
    EXPECT_TRUE(run.arrived) << seed << ": " << run.words;
    EXPECT_GT(run.clearance_m, 0.02) << seed;
  }
}

// The lidar sees but the beginning of the wall that its tail is 2 or 3 cm away from.
TEST(LeavingRun, DoesNotBackIntoAWallThatItHardlySees) {
  const World tail_to_one = world_of({"", "jackal", TightKind::kCorner, 0.02, 135.0});
  const World tail_to_other = world_of({"", "jackal", TightKind::kCorner, 0.03, 315.0});
  int left = 0;
  for (const World& world : {tail_to_one, tail_to_other}) {
    for (const std::uint64_t seed : {1, 2, 3, 4, 6, 8}) {
      const LeavingRun run = run_leaving(world, seed);
      EXPECT_FALSE(run.contact) << seed;
      left += run.arrived;
    }
  }
  EXPECT_GT(left, 2);
}

TEST(LeavingRun, SaysWhyARobotDoesNotArrive) {
  World world = world_of({"", "waveshare_rover", TightKind::kWall, 0.3, 90.0});
  const Vector2 goal = world.robots[0].goal->position;
  const auto box_about = [](const Vector2& centre, double half_m) {
    return Polygon{{centre + Vector2(-half_m, -half_m), centre + Vector2(half_m, -half_m),
                    centre + Vector2(half_m, half_m), centre + Vector2(-half_m, half_m)}};
  };
  world.polygons.push_back(box_about(goal, 0.6));
  const LeavingRun run = run_leaving(world, 1);
  EXPECT_FALSE(run.arrived);
  EXPECT_FALSE(run.contact);
  EXPECT_FALSE(run.words.empty());
}

class LeavingOracle : public ::testing::Test {
 protected:
  static World slot(double yaw_rad, bool can_reverse) {
    RobotModel robot = leaving_model("own");
    robot.limits.can_reverse = can_reverse;
    return leaving_world(robot, {TightKind::kDeadEnd, 0.05, yaw_rad});
  }
};

TEST_F(LeavingOracle, OutOfASlotForwardOrBackward) {
  EXPECT_EQ(leavable(slot(kNoseOut_rad, true)), Leavable::kYes);
  EXPECT_EQ(leavable(slot(kNoseIn_rad, true)), Leavable::kYes);
}

TEST_F(LeavingOracle, WhatCannotReverseStaysNoseInWhereItCannotTurn) {
  EXPECT_EQ(leavable(slot(kNoseOut_rad, false)), Leavable::kYes);
  EXPECT_EQ(leavable(slot(kNoseIn_rad, false)), Leavable::kNo);
}

TEST_F(LeavingOracle, NotOutOfAClosedBox) {
  World world = slot(kNoseOut_rad, true);
  const double top_m = world.polygons.back().corners[2].y();
  world.polygons.push_back(
      Polygon{{{-1.0, top_m - 0.1}, {1.0, top_m - 0.1}, {1.0, top_m}, {-1.0, top_m}}});
  EXPECT_EQ(leavable(world), Leavable::kNo);
}

TEST_F(LeavingOracle, NotWhereItTouches) {
  EXPECT_EQ(leavable(world_of({"", "jackal", TightKind::kWall, 0.001, 0.0})), Leavable::kTouches);
  EXPECT_EQ(leavable(world_of({"", "jackal", TightKind::kWall, 0.02, 0.0})), Leavable::kYes);
}

}  // namespace
}  // namespace mocha
