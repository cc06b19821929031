#include "benchmarks/sighted_drive.h"

#include <gtest/gtest.h>

#include "benchmarks/mover_sightings.h"

namespace mocha {
namespace {

/// 10 m ahead for a rover, or a Jackal, which does not see what is behind it.
World open_world(const std::string& model) {
  World world;
  world.bounds = {Vector2(-8.0, -8.0), Vector2(18.0, 8.0)};
  Goal goal;
  goal.position = {10.0, 0.0};
  world.robots.push_back({"ugv1", load_robot_model("config", model), Pose{}, goal});
  return world;
}

Mover standing(const Vector2& place) { return {0.5, {{0.0, place}}, AfterLast::kStands}; }

TEST(MoverSightings, KnowWhatABeamMeetsOnly) {
  World world = open_world("jackal");
  world.moving = {standing({3.0, 0.0}), standing({6.0, 0.0}), standing({-3.0, 0.0}),
                  standing({0.0, 12.0})};
  MoverSightings sightings(world);
  sightings.look(0.0, Pose{});
  EXPECT_TRUE(sightings.knows(0));
  EXPECT_FALSE(sightings.knows(1)) << "hidden by the first";
  EXPECT_FALSE(sightings.knows(2)) << "behind";
  EXPECT_FALSE(sightings.knows(3)) << "out of range";
  sightings.look(1.0, Pose{Vector2::Zero(), M_PI});
  EXPECT_TRUE(sightings.knows(2));
  EXPECT_TRUE(sightings.knows(0)) << "remembered";
  sightings.look(5.0, Pose{Vector2::Zero(), M_PI});
  EXPECT_FALSE(sightings.knows(0)) << "for 3 s";
}

TEST(MoverSightings, SeeThatSomebodyHasLeft) {
  World world = open_world("rover");
  world.moving = {{0.5, {{0.0, {3.0, 0.0}}, {1.0, {3.0, 0.0}}}, AfterLast::kLeaves}};
  MoverSightings sightings(world);
  sightings.look(0.5, Pose{});
  EXPECT_TRUE(sightings.knows(0));
  sightings.look(1.5, Pose{});
  EXPECT_FALSE(sightings.knows(0));
}

TEST(SightedDrive, IsAsFastAsOneThatKnowsWhereNothingMoves) {
  const World world = open_world("jackal");
  const auto drive = drive_on_sight(world, 1.5, 60.0, {});
  const auto knowing_s = arrival_time_s(problem_of(world, 1.5), solver_options(world, 1.5, 60.0));
  ASSERT_TRUE(drive.arrival_s && knowing_s);
  EXPECT_NEAR(*drive.arrival_s, *knowing_s, 0.3);
  EXPECT_NEAR(*knowing_s, 1.5 + 10.0 / 2.0 + 2.0 / 4.0, 0.5);
}

TEST(SightedDrive, PassesWhatCrosses) {
  World world = open_world("rover");
  world.moving = {along_path(0.4, 1.0, true, {{5.0, -6.0}, {5.0, 6.0}})};
  const auto drive = drive_on_sight(world, 1.5, 60.0, {});
  EXPECT_TRUE(drive.arrival_s);
  EXPECT_TRUE(drive.contacts.empty());
}

TEST(SightedDrive, CannotForeseeWhatAppearsInFrontOfIt) {
  World world = open_world("jackal");
  world.moving = {{0.5, {{4.0, {5.2, 0.0}}, {30.0, {5.2, 0.0}}}, AfterLast::kLeaves}};
  const auto knowing_s = arrival_time_s(problem_of(world, 1.5), solver_options(world, 1.5, 60.0));
  EXPECT_TRUE(knowing_s);
  const auto drive = drive_on_sight(world, 1.5, 60.0, {});
  EXPECT_TRUE(drive.has_own_contact);
  EXPECT_FALSE(drive.arrival_s);
}

TEST(SightedDrive, IsNotToBlameForWhoRunsIntoItAtRest) {
  World world = open_world("jackal");
  world.moving = {
      {0.5, {{0.0, {3.0, 0.0}}, {1.0, {0.0, 0.0}}, {2.0, {-6.0, 0.0}}}, AfterLast::kLeaves}};
  const auto drive = drive_on_sight(world, 0.5, 60.0, {});
  EXPECT_FALSE(drive.has_own_contact);
  EXPECT_TRUE(drive.arrival_s);
}

}  // namespace
}  // namespace mocha
