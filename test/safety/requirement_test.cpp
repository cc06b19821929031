#include "safety/requirement.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "trajectory/rover_braking.h"
#include "trajectory/simple_motions.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

using Name = RequirementName;

constexpr double kNow_s = 1.7e9;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr Name kNames[] = {
    Name::kPlan,    Name::kDetour,        Name::kDetourLikely, Name::kEmergencyDetour,
    Name::kPromise, Name::kPromiseLikely, Name::kRenewal,      Name::kEmergency,
    Name::kEscape,  Name::kTrigger,       Name::kTriggerLikely};

std::shared_ptr<const MovingObstacle> person(double radius_m) {
  return std::make_shared<PredictedDisc>("person", kNow_s, Vector2(3.0, 0.0), Vector2(0.0, 0.0),
                                         radius_m, 0.0);
}

/// A distance that is not asked for is less than any.
double of(const std::optional<double>& distance_m) { return distance_m.value_or(-kInfinity); }

bool asks_no_more(const SpeedMargin& less, const SpeedMargin& more) {
  constexpr double kRounding = 1e-12;
  return less.still_m <= more.still_m + kRounding && less.per_speed2 <= more.per_speed2 + kRounding;
}

/// A margin that is not asked for is less than any.
bool asks_no_more(const std::optional<SpeedMargin>& less, const std::optional<SpeedMargin>& more) {
  return !less || (more && asks_no_more(*less, *more));
}

void expect_equal(const SpeedMargin& margin, const SpeedMargin& expected, const char* name) {
  EXPECT_NEAR(margin.still_m, expected.still_m, 1e-12) << name;
  EXPECT_NEAR(margin.per_speed2, expected.per_speed2, 1e-12) << name;
}

double acceleration_of(const Requirement& requirement) {
  return requirement.limits ? requirement.limits->max_acceleration : kInfinity;
}

/// In each field.
bool asks_no_more(const Requirement& less, const Requirement& more) {
  return acceleration_of(less) >= acceleration_of(more) &&
         asks_no_more(less.obstacle_margin, more.obstacle_margin) &&
         asks_no_more(less.unseen_margin, more.unseen_margin) &&
         less.leaving.way_m >= more.leaving.way_m &&
         of(less.peer_distance_m) <= of(more.peer_distance_m) &&
         of(less.predicted_distance_m) <= of(more.predicted_distance_m) &&
         less.course >= more.course && less.reserve_s >= more.reserve_s;
}

class RequirementsTest : public ::testing::TestWithParam<const char*> {
 protected:
  const RobotModel robot_ = load_robot_model("config", GetParam());
  const Requirements requirements_{robot_};
  const MarginBudget margins_ = MarginBudget::of(robot_);
  const double body_m_ = robot_.footprint.circumscribed_radius_m();
};

TEST_P(RequirementsTest, ThoseOfPlansAndDetoursTakeUnseenSpaceForFree) {
  for (const Name name : {Name::kPlan, Name::kDetour, Name::kDetourLikely, Name::kEmergencyDetour})
    EXPECT_FALSE(requirements_[name].unseen_margin) << to_text(name);
}

TEST_P(RequirementsTest, PromisesKeepTheStaticMarginFromUnseenSpaceToo) {
  for (const Name name : {Name::kPromise, Name::kPromiseLikely, Name::kEmergency, Name::kEscape,
                          Name::kTrigger, Name::kTriggerLikely}) {
    ASSERT_TRUE(requirements_[name].unseen_margin) << to_text(name);
    expect_equal(*requirements_[name].unseen_margin, margins_.static_margin(), to_text(name));
  }
  ASSERT_TRUE(requirements_[Name::kRenewal].unseen_margin);
  expect_equal(*requirements_[Name::kRenewal].unseen_margin, margins_.without_map(), "renewal");
}

TEST_P(RequirementsTest, ThePlanAsksForNothingThatMoves) {
  const Requirement& plan = requirements_[Name::kPlan];
  EXPECT_FALSE(plan.peer_distance_m);
  EXPECT_FALSE(plan.predicted_distance_m);
  EXPECT_FALSE(requirements_[Name::kEscape].predicted_distance_m);
}

TEST_P(RequirementsTest, EachAsksForLimits) {
  for (const Name name : kNames) {
    ASSERT_TRUE(requirements_[name].limits) << to_text(name);
    const MotionLimits& limits = *requirements_[name].limits;
    const bool emergency = name == Name::kRenewal || name == Name::kEmergency ||
                           name == Name::kEscape || name == Name::kEmergencyDetour;
    EXPECT_EQ(limits.max_acceleration,
              emergency ? robot_.emergency_acceleration : robot_.limits.max_acceleration)
        << to_text(name);
    EXPECT_EQ(limits.max_speed, robot_.limits.max_speed);
    EXPECT_EQ(limits.max_yaw_rate, robot_.limits.max_yaw_rate);
    EXPECT_EQ(limits.max_wheel_speed, robot_.limits.max_wheel_speed);
  }
}

TEST_P(RequirementsTest, TheMarginsAreThoseOfTheBudget) {
  for (const Name name : kNames) {
    const Requirement& required = requirements_[name];
    const bool in_force = name == Name::kRenewal;
    expect_equal(required.obstacle_margin,
                 in_force ? margins_.without_map() : margins_.static_margin(), to_text(name));
    EXPECT_NEAR(required.leaving.way_m, 1.0 + 4.0 * body_m_, 1e-12) << to_text(name);
    EXPECT_NEAR(required.leaving.deepest_m, 0.75 * robot_.map_resolution_m + 0.008, 1e-12)
        << to_text(name);
  }
  const double people_m = *requirements_[Name::kPromise].predicted_distance_m;
  EXPECT_NEAR(people_m, body_m_ + margins_.own_margin_m() + robot_.moving_clearance_m, 1e-12);
  const double peers_m = *requirements_[Name::kPromise].peer_distance_m;
  EXPECT_GT(peers_m, distance_to_peers_m(robot_));
  EXPECT_LT(*requirements_[Name::kRenewal].peer_distance_m, distance_to_peers_m(robot_));
  EXPECT_NEAR(distance_to_peers_m(robot_),
              body_m_ + robot_.peer_clearance_m + margins_.peer_margin_m(), 1e-12);
}

/// Down each list, each asks for no more than the one before it, in no field.
TEST_P(RequirementsTest, TheLesserAskForLess) {
  const std::vector<std::vector<Name>> lists = {
      {Name::kDetour, Name::kDetourLikely, Name::kEmergencyDetour},
      {Name::kPromise, Name::kDetour, Name::kPlan},
      {Name::kPromise, Name::kPromiseLikely, Name::kEmergency, Name::kEscape},
      {Name::kPromise, Name::kTrigger, Name::kTriggerLikely},
      {Name::kPromise, Name::kPromiseLikely, Name::kEmergency, Name::kRenewal}};
  for (const auto& list : lists) {
    for (std::size_t i = 1; i < list.size(); ++i) {
      const Requirement& more = requirements_[list[i - 1]];
      const Requirement& less = requirements_[list[i]];
      EXPECT_TRUE(asks_no_more(less, more)) << to_text(list[i - 1]) << ", " << to_text(list[i]);
      EXPECT_FALSE(asks_no_more(more, less)) << to_text(list[i - 1]) << ", " << to_text(list[i]);
    }
  }
}

TEST_P(RequirementsTest, HaveTheirOwnNames) {
  std::set<std::string> words;
  for (const Name name : kNames) words.insert(to_text(name));
  words.insert(to_text(Name::kNone));
  EXPECT_EQ(words.size(), std::size(kNames) + 1);
  EXPECT_EQ(words.size(), static_cast<std::size_t>(Name::kNone) + 1);
  EXPECT_EQ(words.count("unknown"), 0u);
}

TEST_P(RequirementsTest, AStretchOfTimeLeavesTheRestAsItIs) {
  const Requirement& promise = requirements_[Name::kPromise];
  EXPECT_EQ(promise.from_s, -kInfinity);
  EXPECT_EQ(promise.until_s, kInfinity);
  EXPECT_EQ(promise.limits_from_s, -kInfinity);
  const Requirement stretch = promise.from(1.0).joining_at(2.0).until(3.0);
  EXPECT_EQ(stretch.from_s, 1.0);
  EXPECT_EQ(stretch.limits_from_s, 2.0);
  EXPECT_EQ(stretch.until_s, 3.0);
  EXPECT_TRUE(asks_no_more(stretch, promise) && asks_no_more(promise, stretch));
}

TEST_P(RequirementsTest, WhatMovesIsKeptAsFarAsIsAskedFor) {
  Scene scene;
  scene.peers = {std::make_shared<PeerObstacle>(
      "ugv2", std::make_shared<const Motion>(standing(kNow_s, {5.0, 0.0}, 0.0)), 0.3,
      test::kRoverBraking)};
  scene.confident = {person(0.5)};
  scene.likely = {person(0.25)};
  scene.predicted_until_s = kNow_s + 5.0;
  for (const Name name : kNames) {
    const Requirement required = requirements_[name].from(kNow_s + 1.0);
    const auto things = kept_apart(scene, required);
    ASSERT_EQ(things.size(), static_cast<std::size_t>(required.peer_distance_m.has_value()) +
                                 required.predicted_distance_m.has_value())
        << to_text(name);
    if (required.peer_distance_m) {
      EXPECT_EQ(things.front().obstacle, scene.peers.front());
      EXPECT_EQ(things.front().keep_m, *required.peer_distance_m);
      EXPECT_EQ(things.front().until_s, kNow_s + 11.0);
    }
    if (!required.predicted_distance_m) continue;
    const auto& expected = required.course == Course::kLikely ? scene.likely : scene.confident;
    EXPECT_EQ(things.back().obstacle, expected.front()) << to_text(name);
    EXPECT_EQ(things.back().keep_m, *required.predicted_distance_m);
    EXPECT_EQ(things.back().until_s, scene.predicted_until_s - required.reserve_s);
  }
}

TEST_P(RequirementsTest, WithoutALikelyCourseTheConfidentOneStandsForBoth) {
  Scene scene;
  scene.confident = {person(0.5)};
  for (const Name name : {Name::kPromise, Name::kPromiseLikely, Name::kRenewal}) {
    const auto things = kept_apart(scene, requirements_[name]);
    ASSERT_EQ(things.size(), 1u);
    EXPECT_EQ(things.front().obstacle, scene.confident.front()) << to_text(name);
  }
  EXPECT_TRUE(kept_apart({}, requirements_[Name::kPromise]).empty());
}

INSTANTIATE_TEST_SUITE_P(Robots, RequirementsTest, ::testing::Values("rover", "jackal"));

}  // namespace
}  // namespace mocha
