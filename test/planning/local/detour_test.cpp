#include "planning/local/detour.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"
#include "trajectory/splice.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;
constexpr double kSettle_s = 0.3;

class DetourTest : public ::testing::Test {
 protected:
  LocalScene scene(double now_s, double y) const {
    LocalScene scene = open_scene_;
    scene.confident = {std::make_shared<PredictedDisc>("person", now_s, Vector2(person_x_, y),
                                                       Vector2(0.0, 0.0), 0.25, 0.0)};
    scene.predicted_until_s = now_s + 5.0;
    return scene;
  }
  LocalScene empty(double now_s) const {
    LocalScene scene = open_scene_;
    scene.predicted_until_s = now_s + 5.0;
    return scene;
  }
  Detour::Start on(const Motion& motion, double now_s) const {
    return {now_s, now_s + kSettle_s, motion, motion, true};
  }
  /// On a detour around a person that stands ahead.
  Motion taken_detour() {
    const auto plan = detour_.around(on(ahead_, begin_s_), scene(begin_s_, 0.1));
    EXPECT_TRUE(plan);
    EXPECT_EQ(plan->met, RequirementName::kDetour) << plan->message;
    detour_.take(begin_s_, ahead_, *plan);
    taken_ = *plan;
    return splice(ahead_, begin_s_, plan->motion.start_time(), plan->motion).motion;
  }

  /// When it is beside the person.
  double passing_s(const Motion& motion) const {
    double t = motion.start_time();
    while (t < motion.end_time() && motion.position(t).x() < person_x_) t += 0.05;
    return t;
  }

  const RobotModel robot_ = rover();
  Detour detour_{robot_, default_local_options(), [](LocalStage) {}};
  const OccupancyGrid open_ = free_grid({-2.0, -5.0}, {18.0, 5.0});
  const LocalScene open_scene_ = scene_of(open_);
  const Motion ahead_ = long_drive(kNow_s, 14.0);
  const double begin_s_ = kNow_s + 3.0;
  double person_x_ = 5.2;
  LocalPlan taken_;
};

TEST_F(DetourTest, DoesNotTryAgainAtOnce) {
  const Motion driven = taken_detour();
  EXPECT_FALSE(detour_.around(on(driven, begin_s_ + 0.1), scene(begin_s_, -0.1)));
  EXPECT_TRUE(detour_.around(on(driven, begin_s_ + 0.2), scene(begin_s_, -0.1)));
  // That one was not taken.
  EXPECT_FALSE(detour_.around(on(driven, begin_s_ + 0.5), scene(begin_s_, -0.1)));
  EXPECT_TRUE(detour_.around(on(driven, begin_s_ + 0.6), scene(begin_s_, -0.1)));
}

TEST_F(DetourTest, ComesBackToThePlanItLeftNotToTheDetour) {
  const Motion driven = taken_detour();
  const double now_s = begin_s_ + 0.6;
  // Back at the plan, the detour would be half a second later than it has to be.
  const auto again = detour_.around(on(driven, now_s), scene(now_s, 0.1));
  ASSERT_TRUE(again);
  ASSERT_EQ(again->met, RequirementName::kDetour) << again->message;
  EXPECT_LT(std::abs(again->rejoin_point.place().y()), 1e-6);
  // The rejoin point is a time of the plan that was left: that is where it stands then.
  EXPECT_LT((ahead_.position(again->rejoin_point.plan_time_s) - again->rejoin_point.place()).norm(),
            1e-6);
  detour_.forget();
  const auto within = detour_.around(on(driven, now_s + 1.0), scene(now_s, 0.1));
  ASSERT_TRUE(within);
  EXPECT_LT(
      (driven.position(within->rejoin_point.plan_time_s) - within->rejoin_point.place()).norm(),
      1e-6);
}

TEST_F(DetourTest, KnowsItsSideThoughItHadToBrake) {
  const Motion driven = taken_detour();
  const double brake_s = driven.switch_time(begin_s_ + 0.6);
  const Motion brakes = with_brake(driven, begin_s_ + 0.4, brake_s, Braking(0.5));
  // As far as the tracker can tell, he stands a little on the other side of the plan now.
  const auto again = detour_.around({brake_s, brake_s + kSettle_s, brakes, taken_.motion, false},
                                    scene(brake_s, -0.05));
  ASSERT_TRUE(again);
  ASSERT_EQ(again->met, RequirementName::kDetour) << again->message;
  EXPECT_FALSE(again->switches_class);
  EXPECT_LT(again->motion.position(passing_s(again->motion)).y(), 0.0);
}

TEST_F(DetourTest, ComesBackWhereItWouldHave) {
  person_x_ = ahead_.position(begin_s_ + kSettle_s + default_local_options().mu_s).x();
  const Motion driven = taken_detour();
  ASSERT_GT(taken_.rejoin_point.place().x(), person_x_ + 0.5) << "beyond him";
  const double now_s = begin_s_ + 0.6;
  const auto again = detour_.around(on(driven, now_s), scene(now_s, 0.1));
  ASSERT_TRUE(again);
  EXPECT_NEAR(again->rejoin_point.plan_time_s, taken_.rejoin_point.plan_time_s, 1e-6);
  EXPECT_FALSE(again->switches_class);
}

/// Where a detour came back to another plan, far beside the first one, says nothing of that.
TEST_F(DetourTest, TheRejoinPointIsThatOfItsPlan) {
  taken_detour();
  const double later_s = begin_s_ + 6.0;
  const Motion beside = straight_drive(later_s - 2.0, {0.0, 3.0}, 0.0, 8.0, 0.9, 0.5);
  LocalScene there = empty(later_s);
  there.confident = {std::make_shared<PredictedDisc>(
      "person", later_s, beside.position(later_s + 4.0), Vector2(0.0, 0.0), 0.25, 0.0)};
  const auto around = detour_.around(on(beside, later_s), there);
  ASSERT_TRUE(around);
  ASSERT_EQ(around->met, RequirementName::kDetour) << around->message;
  ASSERT_NEAR(around->rejoin_point.place().y(), 3.0, 0.1);
  detour_.take(later_s, beside, *around);

  const double now_s = later_s + 1.0;
  const Motion stands = standing(now_s - 0.5, ahead_.position(begin_s_), 0.0);
  const auto again =
      detour_.around({now_s, now_s + kSettle_s, stands, ahead_, false}, scene(now_s, 1.2));
  ASSERT_TRUE(again);
  EXPECT_NEAR(again->rejoin_point.plan_time_s, begin_s_ + default_local_options().mu_s, 0.1);
}

TEST_F(DetourTest, IsBackSoonerWhenNothingIsThereAnyMore) {
  // What crosses slowly from the right is let pass.
  LocalScene crossing = scene(begin_s_, 0.0);
  crossing.confident = {std::make_shared<PredictedDisc>("person", begin_s_, Vector2(4.2, -1.0),
                                                        Vector2(-0.1, 0.3), 0.6, 0.0)};
  const auto plan = detour_.around(on(ahead_, begin_s_), crossing);
  ASSERT_TRUE(plan);
  ASSERT_EQ(plan->met, RequirementName::kDetour) << plan->message;
  ASSERT_GT(plan->delay_s, 0.4);
  detour_.take(begin_s_, ahead_, *plan);
  const Motion driven = splice(ahead_, begin_s_, plan->motion.start_time(), plan->motion).motion;
  EXPECT_FALSE(detour_.sooner(on(driven, begin_s_ + 0.4), empty(begin_s_ + 0.4))) << "too soon";
  const double now_s = begin_s_ + 0.6;
  Detour::Start brakes = on(driven, now_s);
  brakes.follows_plan = false;
  EXPECT_FALSE(detour_.sooner(brakes, empty(now_s)));
  const auto sooner = detour_.sooner(on(driven, now_s), empty(now_s));
  ASSERT_TRUE(sooner);
  EXPECT_LT(sooner->motion.end_time(), driven.end_time() - 0.2);
  EXPECT_LT((sooner->motion.end_pose().position - ahead_.end_pose().position).norm(), 1e-4);
  const double back_s = plan->rejoins_s + 0.1;
  EXPECT_FALSE(detour_.sooner(on(driven, back_s), empty(back_s))) << "is back already";
}

TEST_F(DetourTest, IsNotDisturbedWhileItCannotBeSooner) {
  const Motion driven = taken_detour();
  ASSERT_LT(driven.end_time(), ahead_.end_time() + 0.1);
  for (double later_s = 0.6; begin_s_ + later_s < taken_.rejoins_s; later_s += 0.6) {
    const double now_s = begin_s_ + later_s;
    EXPECT_FALSE(detour_.sooner(on(driven, now_s), scene(now_s, 0.1))) << later_s;
  }
}

TEST_F(DetourTest, WhatIsHarderIsCalledAnEmergency) {
  int harder = 0;
  for (double apart_s = 0.8; apart_s < 2.5; apart_s += 0.1) {
    LocalScene close = scene(begin_s_, 0.0);
    close.confident = {std::make_shared<PredictedDisc>(
        "person", begin_s_, ahead_.position(begin_s_ + kSettle_s + apart_s), Vector2(-0.3, 0.1),
        0.25, 0.0)};
    Detour detour{robot_, default_local_options(), [](LocalStage) {}};
    const auto failed = detour.around(on(ahead_, begin_s_), close);
    ASSERT_TRUE(failed);
    if (failed->met != RequirementName::kNone || failed->candidates.empty()) continue;
    const LocalPlan found = detour.harder(on(ahead_, begin_s_), close, *failed);
    EXPECT_GE(found.met, RequirementName::kEmergencyDetour);
    harder += found.met == RequirementName::kEmergencyDetour;
  }
  EXPECT_GT(harder, 0);
}

TEST_F(DetourTest, FarFromThePlanThereIsNoWayBack) {
  const Motion stands = standing(begin_s_ - 5.0, {3.0, 3.0}, 0.0);
  EXPECT_FALSE(detour_.around({begin_s_, begin_s_ + kSettle_s, stands, ahead_, false},
                              scene(begin_s_, 0.1)));
}

}  // namespace
}  // namespace mocha
