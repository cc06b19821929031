#include "planning/candidates/exposure.h"

#include <gtest/gtest.h>

#include <random>

#include "planning/maneuver_test.h"
#include "trajectory/random_motion.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

constexpr double kOwn_m = 0.3;
constexpr double kRounding_m = 2e-3;  // within which a proof may refuse what is free

/// The least room to what is kept, and the first moment without any; sampled so densely that
/// nothing slips through.
struct Sampled {
  double room_m = std::numeric_limits<double>::infinity();
  double first_s = std::numeric_limits<double>::infinity();
};

Sampled sampled(const Motion& plan, const MovingThing& thing, double from_s, double until_s) {
  Sampled found;
  const double closing = 3.0 + thing.obstacle->max_closing_speed(from_s);
  until_s = std::min(until_s, thing.until_s);
  for (double t = from_s; t <= until_s; t += 1e-3 / closing) {
    const MovingObstacle::Disc disc = thing.obstacle->at(t);
    const double room_m =
        (plan.at(t).pose.position - disc.centre).norm() - disc.radius_m - thing.keep_m;
    found.room_m = std::min(found.room_m, room_m);
    if (room_m < 0.0) found.first_s = std::min(found.first_s, t);
  }
  return found;
}

class ConflictTest : public ::testing::Test {
 protected:
  const Motion plan_ = straight_drive(0.0, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5);

  Violation conflict(std::vector<MovingThing> things, double from_s, double mu_pre_s) const {
    return conflict_of(plan_, things, kOwn_m, from_s, mu_pre_s);
  }
  static MovingThing thing(const Vector2& centre, const Vector2& velocity, double radius_m,
                           double keep_m, double until_s = kForever_s) {
    return {std::make_shared<PredictedDisc>("person", 0.0, centre, velocity, radius_m, 0.0), keep_m,
            until_s};
  }
};

TEST_F(ConflictTest, NothingSlipsThrough) {
  // Thin and fast: at 30 m/s, a disc is over a robot and gone within 20 ms.
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int conflicts = 0;
  for (int seed = 0; seed < 400; ++seed) {
    const Motion plan = within(random_drive(seed, 6), {1.0, 1.0, 1.5}, 0.0);
    const double meets_s = 3.5 * unit(random);
    const double course = 2.0 * M_PI * unit(random);
    const Vector2 velocity =
        std::pow(30.0, unit(random)) * Vector2(std::cos(course), std::sin(course));
    const Vector2 aside = 0.8 * unit(random) * Vector2(-velocity.y(), velocity.x()).normalized();
    const Vector2 centre = plan.at(meets_s).pose.position + aside - meets_s * velocity;
    const MovingThing passing{
        std::make_shared<PredictedDisc>("p", 0.0, centre, velocity, 0.01 + 0.1 * unit(random),
                                        0.1 * unit(random)),
        kOwn_m, kForever_s};
    const Sampled truth = sampled(plan, passing, 0.0, 3.0);
    const Violation found = conflict_of(plan, {passing}, 0.2, 0.0, 3.0);
    EXPECT_TRUE(found || truth.room_m >= 0.0) << seed << ": slips through";
    EXPECT_TRUE(!found || truth.room_m < kRounding_m) << seed << ": " << describe(found);
    if (!found || !(truth.room_m < -0.02)) continue;
    ++conflicts;
    EXPECT_NEAR(found.time_s, truth.first_s, 0.05) << seed;
    EXPECT_LE(found.time_s, truth.first_s + 0.01) << seed;
  }
  EXPECT_GT(conflicts, 100);
}

TEST_F(ConflictTest, LooksNoFartherAheadThanMuPre) {
  const double meets_s = 6.0;
  const double x = plan_.at(meets_s).pose.position.x();
  const MovingThing crossing = thing({x, -6.0}, {0.0, 1.0}, 0.25, 0.5);
  EXPECT_TRUE(conflict({crossing}, 0.0, 7.0));
  EXPECT_FALSE(conflict({crossing}, 0.0, 4.5));
  EXPECT_TRUE(conflict({crossing}, 2.5, 4.5));
  EXPECT_FALSE(conflict({crossing}, 8.0, 4.5));  // it has passed
}

TEST_F(ConflictTest, ForgetsWhatDoesNotCountAnyMore) {
  const double x = plan_.at(6.0).pose.position.x();
  EXPECT_FALSE(conflict({thing({x, -6.0}, {0.0, 1.0}, 0.25, 0.5, 4.5)}, 0.0, 9.0));
  EXPECT_FALSE(conflict({thing({x, 0.0}, {0.0, 0.0}, 0.25, 0.5, -1.0)}, 0.0, 9.0));
  EXPECT_FALSE(conflict({}, 0.0, 9.0));
}

TEST_F(ConflictTest, IsTheFirstOfAllThings) {
  const MovingThing far = thing({6.0, 0.0}, {0.0, 0.0}, 0.25, 0.5);
  const MovingThing near = thing({3.0, 0.0}, {0.0, 0.0}, 0.25, 0.5);
  const Violation alone = conflict({near}, 0.0, 20.0);
  for (const auto& things : {std::vector{far, near}, std::vector{near, far}}) {
    const Violation first = conflict(things, 0.0, 20.0);
    EXPECT_EQ(first.time_s, alone.time_s);
    EXPECT_EQ(first.term, ViolatedTerm::kSeparation);
    EXPECT_NEAR(plan_.at(first.time_s).pose.position.x(), 2.25, 0.05);
  }
}

TEST_F(ConflictTest, ARobotThatIsTooCloseAlreadyMayLeave) {
  const MovingThing behind = thing({-0.5, 0.0}, {0.0, 0.0}, 0.25, 0.5);
  EXPECT_FALSE(conflict({behind}, 0.0, 9.0));
  const MovingThing ahead = thing({0.5, 0.0}, {0.0, 0.0}, 0.25, 0.5);
  EXPECT_TRUE(conflict({ahead}, 0.0, 9.0));
}

TEST_F(ConflictTest, LeastRoomIsTheLeastOfAllThings) {
  const MovingThing crossing = thing({4.0, -4.0}, {0.0, 1.0}, 0.25, 0.5);
  const MovingThing beside = thing({4.0, 2.0}, {0.0, 0.0}, 0.25, 0.5);
  const double first_m = sampled(plan_, crossing, 0.0, 9.0).room_m;
  EXPECT_NEAR(least_room_m(plan_, {crossing}, 0.0, 9.0), first_m, 0.05);
  EXPECT_NEAR(least_room_m(plan_, {beside}, 0.0, 9.0), 1.25, 0.01);
  EXPECT_EQ(
      least_room_m(plan_, {crossing, beside}, 0.0, 9.0),
      std::min(least_room_m(plan_, {crossing}, 0.0, 9.0), least_room_m(plan_, {beside}, 0.0, 9.0)));
  EXPECT_GT(least_room_m(plan_, {crossing}, 0.0, 1.0), 2.0);
  EXPECT_TRUE(std::isinf(least_room_m(plan_, {}, 0.0, 9.0)));
}

TEST(Foreseen, WhatNeverRestsCountsForGood) {
  const auto goes = std::make_shared<PredictedDisc>("person", 0.0, Vector2(0.0, 0.0),
                                                    Vector2(0.5, 0.0), 0.25, 0.0);
  const auto drives = std::make_shared<PeerObstacle>(
      "ugv2", std::make_shared<const Motion>(straight_drive(0.0, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5)),
      0.3, test::kRoverBraking);
  const auto things = foreseen({{goes, 0.5, 4.0}, {drives, 0.6, 10.0}});
  ASSERT_EQ(things.size(), 2u);
  EXPECT_EQ(things[0].until_s, kForever_s);
  EXPECT_EQ(things[1].until_s, 10.0) << "is known to come to rest";
  EXPECT_EQ(things[0].keep_m, 0.5);
}

/// What the motion or braking meets is foreseen for good, all else as long as it is predicted.
class ExposureTest : public ManeuverTest {};

TEST_F(ExposureTest, WhatIsMetCountsForGood) {
  constexpr double kNow_s = 1.7e9;
  const OccupancyGrid grid = free_grid({-8.0, -8.0}, {12.0, 8.0});
  const Motion ahead = straight_drive(kNow_s - 3.0, {-2.0, 0.0}, 0.0, 8.0, 0.9, 0.5);
  const Vector2 here = ahead.position(kNow_s);
  LocalScene scene = scene_of(grid);
  const auto meets_motion = person(kNow_s, here + Vector2(3.0, 0.0), {-0.5, 0.0});
  const auto meets_stop = person(kNow_s, here + Vector2(-2.0, 0.0), {0.7, 0.0});
  const auto passes_later = person(kNow_s, here + Vector2(0.0, 8.0), {0.0, -1.0});
  scene.confident = {meets_motion, meets_stop, passes_later};
  scene.predicted_until_s = kNow_s + 5.0;
  const ManeuverStart start = start_of(ahead, scene, kNow_s);
  const auto things = exposed_to(start, kNow_s);
  ASSERT_EQ(things.size(), 3u);
  EXPECT_EQ(things[0].until_s, kForever_s);
  EXPECT_EQ(things[1].until_s, kForever_s);
  EXPECT_EQ(things[2].until_s, scene.predicted_until_s);
  for (const MovingThing& thing : things)
    EXPECT_EQ(thing.keep_m, *requirements_[RequirementName::kPromise].predicted_distance_m);
}

TEST_F(ExposureTest, IsThatToTheCourseThatIsAskedFor) {
  constexpr double kNow_s = 1.7e9;
  const OccupancyGrid grid = free_grid({-8.0, -8.0}, {12.0, 8.0});
  const Motion stands = standing(kNow_s - 1.0, {0.0, 0.0}, 0.0);
  LocalScene scene = scene_of(grid);
  scene.confident = {person(kNow_s, {3.0, 0.0}, {0.0, 0.0})};
  scene.likely = {person(kNow_s, {4.0, 0.0}, {0.0, 0.0})};
  scene.peers = {peer(standing(kNow_s, {0.0, 6.0}, 0.0))};
  scene.predicted_until_s = kNow_s + 5.0;
  for (const Course course : {Course::kConfident, Course::kLikely}) {
    const auto things = exposed_to(start_of(stands, scene, kNow_s, course), kNow_s);
    ASSERT_EQ(things.size(), 2u);
    EXPECT_EQ(things[0].obstacle, scene.peers[0]);
    EXPECT_EQ(things[1].obstacle, (course == Course::kLikely ? scene.likely : scene.confident)[0]);
  }
}

}  // namespace
}  // namespace mocha
