#include "perception/localization/branch_and_bound_matcher.h"

#include <gtest/gtest.h>

#include "perception/localization/localisation_scene.h"

namespace mocha {
namespace {

constexpr int kBudget = 2000000;

/// A free rectangle with walls around it, cells of 5 cm.
OccupancyGrid room(int width, int height) {
  OccupancyGrid grid;
  grid.resolution_m = 0.05;
  grid.width = width;
  grid.height = height;
  grid.cells.assign(static_cast<std::size_t>(width) * height, OccupancyGrid::kFree);
  for (int x = 0; x < width; ++x) grid.at(x, 0) = grid.at(x, height - 1) = OccupancyGrid::kOccupied;
  for (int y = 0; y < height; ++y) grid.at(0, y) = grid.at(width - 1, y) = OccupancyGrid::kOccupied;
  return grid;
}

/// What a lidar sees in such a room, from a pose.
ScanHits seen_in(const OccupancyGrid& room, const Pose& pose) {
  ScanHits scan;
  for (double angle = 0.0; angle < 2.0 * M_PI; angle += 0.05) {
    const Vector2 ray(std::cos(pose.yaw_rad + angle), std::sin(pose.yaw_rad + angle));
    double range = 0.0;
    const auto occupied = [&](const Vector2& p) {
      return room.at(static_cast<int>(p.x() / room.resolution_m),
                     static_cast<int>(p.y() / room.resolution_m)) == OccupancyGrid::kOccupied;
    };
    while (!occupied(pose.position + range * ray)) range += 0.01;
    scan.hits.push_back(range * Vector2(std::cos(angle), std::sin(angle)));
  }
  return scan;
}

double score_at(const ScanHits& scan, const LikelihoodField& walls, const Pose& pose,
                double reach_m) {
  double sum = 0.0;
  for (const Vector2& hit : scan.hits) {
    const double ratio = walls.sample(composed(pose, {hit, 0.0}).position).distance_m / reach_m;
    sum += std::exp(-0.5 * ratio * ratio);
  }
  return sum / static_cast<double>(scan.hits.size());
}

TEST(BranchAndBoundMatcherTest, FindsThePlaceInARoomWithANiche) {
  OccupancyGrid grid = room(120, 80);
  for (int y = 50; y < 80; ++y)
    for (int x = 90; x < 120; ++x) grid.at(x, y) = OccupancyGrid::kOccupied;
  const LikelihoodField walls(grid, 1.0);
  for (const Pose& pose : {Pose{{1.2, 1.0}, 0.4}, Pose{{4.0, 2.0}, -2.0}, Pose{{3.0, 3.3}, 3.0}}) {
    const auto result = BranchAndBoundMatcher(walls, {kBudget}).find(seen_in(grid, pose));
    ASSERT_FALSE(result.places.empty());
    EXPECT_TRUE(result.complete);
    EXPECT_LT(distance_m(result.places[0].pose, pose), 0.08);
    EXPECT_LT(turn_rad(result.places[0].pose, pose), 0.04);
  }
}

TEST(BranchAndBoundMatcherTest, FindsBothPlacesOfARoomThatLooksTheSameFromBoth) {
  const OccupancyGrid grid = room(120, 80);
  const LikelihoodField walls(grid, 1.0);
  const Pose pose{{1.5, 1.2}, 0.5};
  const Pose twin{{120 * 0.05 - 1.5, 80 * 0.05 - 1.2}, 0.5 - M_PI};
  const auto places = BranchAndBoundMatcher(walls, {kBudget}).find(seen_in(grid, pose)).places;
  ASSERT_GE(places.size(), 2u);
  for (const Pose& wanted : {pose, twin}) {
    EXPECT_TRUE(std::any_of(places.begin(), places.begin() + 2, [&](const auto& place) {
      return distance_m(place.pose, wanted) < 0.08 && turn_rad(place.pose, wanted) < 0.04;
    }));
  }
  EXPECT_NEAR(places[0].score, places[1].score, 0.05);
}

TEST(BranchAndBoundMatcherTest, FindsThePlaceThatIsBestWhenAllAreLookedAt) {
  OccupancyGrid grid = room(60, 50);
  for (int y = 30; y < 40; ++y) grid.at(25, y) = OccupancyGrid::kOccupied;
  const LikelihoodField walls(grid, 1.0);
  ScanHits scan = thinned(seen_in(grid, {{0.9, 1.1}, 1.0}), BranchAndBoundMatcher::Options{}.hits);
  for (std::size_t i = 0; i < 20; ++i) scan.hits[i] *= 0.6;  // a person stands there
  const auto places = BranchAndBoundMatcher(walls, {kBudget}).find(scan).places;
  ASSERT_FALSE(places.empty());
  double best = 0.0;
  Pose best_pose{{0.0, 0.0}, 0.0};
  for (int y = 1; y < 49; ++y) {
    for (int x = 1; x < 59; ++x) {
      if (grid.at(x, y) != OccupancyGrid::kFree) continue;
      for (double yaw = 0.0; yaw < 2.0 * M_PI; yaw += 0.026) {
        const Pose pose{grid.cell_centre(x, y), yaw};
        const double score = score_at(scan, walls, pose, BranchAndBoundMatcher::kReach_m);
        if (score > best) best_pose = pose;
        best = std::max(best, score);
      }
    }
  }
  EXPECT_LT(distance_m(places[0].pose, best_pose), 0.11);
  EXPECT_LT(turn_rad(places[0].pose, best_pose), 0.06);
}

TEST(BranchAndBoundMatcherTest, ARobotNeverStandsInAWallOrWhereNothingIsKnown) {
  OccupancyGrid grid = room(120, 80);
  const ScanHits scan = seen_in(grid, {{1.5, 1.2}, 0.5});
  for (int y = 1; y < 79; ++y)
    for (int x = 1; x < 60; ++x) grid.at(x, y) = OccupancyGrid::kUnknown;
  const LikelihoodField walls(grid, 1.0);
  for (const auto& place : BranchAndBoundMatcher(walls, {kBudget}).find(scan).places)
    EXPECT_EQ(walls.cell(place.pose.position), OccupancyGrid::kFree);
}

TEST(BranchAndBoundMatcherTest, FindsNothingInAnotherRoom) {
  const ScanHits scan = seen_in(room(200, 60), {{2.0, 1.0}, 0.5});
  const LikelihoodField walls(room(40, 40), 1.0);
  EXPECT_TRUE(BranchAndBoundMatcher(walls, {kBudget}).find(scan).places.empty());
  EXPECT_TRUE(BranchAndBoundMatcher(walls, {kBudget}).find({}).places.empty());
}

TEST(BranchAndBoundMatcherTest, SaysSoWhenItGaveUp) {
  const OccupancyGrid grid = room(120, 80);
  const LikelihoodField walls(grid, 1.0);
  EXPECT_FALSE(BranchAndBoundMatcher(walls, {50}).find(seen_in(grid, {{1.5, 1.2}, 0.5})).complete);
}

TEST(BranchAndBoundMatcherTest, FindsEveryPlaceOfADriveThroughTheCorridor) {
  World world = one_robot_world("config/worlds/corridor.yaml", {{0.0, 0.0}, 0.0});
  const RobotModel& model = world.robots[0].model;
  const LikelihoodField walls(map_of(drive_through(world, corridor_path(), 1), model), 1.0);
  const BranchAndBoundMatcher search(walls, {kBudget});
  const auto drive = drive_through(world, corridor_path(), 2);
  for (std::size_t i = 0; i < drive.size(); i += 25) {
    const auto result = search.find(hits_of(drive[i], model.lidar));
    ASSERT_FALSE(result.places.empty()) << i;
    EXPECT_LT(distance_m(result.places[0].pose, drive[i].truth), 0.1) << i;
    EXPECT_LT(turn_rad(result.places[0].pose, drive[i].truth), 0.05) << i;
  }
}

}  // namespace
}  // namespace mocha
