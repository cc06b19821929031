#include "planning/swerving.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;
constexpr double kSettle_s = 0.3;

class SwervingTest : public ::testing::Test {
 protected:
  PromiseScene scene(double now_s, double y) const {
    PromiseScene scene{field_, unseen_};
    scene.moving = {std::make_shared<PredictedDisc>("person", now_s, Vector2(person_x_, y),
                                                    Vector2(0.0, 0.0), 0.25, 0.0)};
    scene.predicted_until_s = now_s + 5.0;
    return scene;
  }
  PromiseScene nobody(double now_s) const {
    PromiseScene scene{field_, unseen_};
    scene.predicted_until_s = now_s + 5.0;
    return scene;
  }
  Swerving::Situation on(const Motion& motion, double now_s) const {
    return {now_s, now_s + kSettle_s, motion, motion, true};
  }
  /// Swerves around somebody who stands ahead.
  Motion swerved() {
    const auto plan = swerving_.around(on(ahead_, begin_s_), scene(begin_s_, 0.1));
    EXPECT_TRUE(plan);
    EXPECT_EQ(plan->proof, LocalProof::kAsked) << plan->message;
    swerving_.take(begin_s_, ahead_, *plan);
    taken_ = *plan;
    return continued(ahead_, begin_s_, plan->motion.start_time(), plan->motion);
  }

  /// When it is beside the person.
  double passing_s(const Motion& motion) const {
    double t = motion.start_time();
    while (t < motion.end_time() && motion.position(t).x() < person_x_) t += 0.05;
    return t;
  }

  const RobotModel robot_ = rover();
  Swerving swerving_{robot_, default_local_rules(), [](LocalStage) {}};
  const OccupancyGrid open_ = free_grid({-2.0, -5.0}, {18.0, 5.0});
  const std::shared_ptr<const DistanceField> field_ = occupied_field(open_);
  const std::shared_ptr<const DistanceField> unseen_ = unseen_field(open_);
  const Motion ahead_ = long_drive(kNow_s, 14.0);
  const double begin_s_ = kNow_s + 3.0;
  double person_x_ = 5.2;
  LocalPlan taken_;
};

TEST_F(SwervingTest, DoesNotTryAgainAtOnce) {
  const Motion driven = swerved();
  EXPECT_FALSE(swerving_.around(on(driven, begin_s_ + 0.1), scene(begin_s_, -0.1)));
  EXPECT_TRUE(swerving_.around(on(driven, begin_s_ + 0.2), scene(begin_s_, -0.1)));
  // That one was not taken.
  EXPECT_FALSE(swerving_.around(on(driven, begin_s_ + 0.5), scene(begin_s_, -0.1)));
  EXPECT_TRUE(swerving_.around(on(driven, begin_s_ + 0.6), scene(begin_s_, -0.1)));
}

TEST_F(SwervingTest, ComesBackToThePlanItLeftNotToTheSwerve) {
  const Motion driven = swerved();
  const double now_s = begin_s_ + 0.6;
  // Back at the plan, the swerve would be half a second later than it has to be.
  const auto again = swerving_.around(on(driven, now_s), scene(now_s, 0.1));
  ASSERT_TRUE(again);
  ASSERT_EQ(again->proof, LocalProof::kAsked) << again->message;
  EXPECT_LT(std::abs(again->anchor.place().y()), 1e-6);
  // The anchor is a time of the plan that was left: that is where it stands then.
  EXPECT_LT((ahead_.position(again->anchor.plan_time_s) - again->anchor.place()).norm(), 1e-6);
  swerving_.forget();
  const auto within = swerving_.around(on(driven, now_s + 1.0), scene(now_s, 0.1));
  ASSERT_TRUE(within);
  EXPECT_LT((driven.position(within->anchor.plan_time_s) - within->anchor.place()).norm(), 1e-6);
}

TEST_F(SwervingTest, KnowsItsSideThoughItHadToBrake) {
  const Motion driven = swerved();
  const double brake_s = driven.switch_time(begin_s_ + 0.6);
  const Motion brakes = with_brake(driven, driven.cut_time(begin_s_ + 0.4), brake_s, 0.5);
  // As far as the tracker can tell, he stands a little on the other side of the plan now.
  const auto again = swerving_.around({brake_s, brake_s + kSettle_s, brakes, taken_.motion, false},
                                      scene(brake_s, -0.05));
  ASSERT_TRUE(again);
  ASSERT_EQ(again->proof, LocalProof::kAsked) << again->message;
  EXPECT_FALSE(again->switches_class);
  EXPECT_LT(again->motion.position(passing_s(again->motion)).y(), 0.0);
}

TEST_F(SwervingTest, ComesBackWhereItWouldHave) {
  person_x_ = ahead_.position(begin_s_ + kSettle_s + default_local_rules().mu_s).x();
  const Motion driven = swerved();
  ASSERT_GT(taken_.anchor.place().x(), person_x_ + 0.5) << "beyond him";
  const double now_s = begin_s_ + 0.6;
  const auto again = swerving_.around(on(driven, now_s), scene(now_s, 0.1));
  ASSERT_TRUE(again);
  EXPECT_NEAR(again->anchor.plan_time_s, taken_.anchor.plan_time_s, 1e-6);
  EXPECT_FALSE(again->switches_class);
}

/// Where a swerve came back to another plan, far beside the first one, says nothing of that.
TEST_F(SwervingTest, TheAnchorIsThatOfItsPlan) {
  swerved();
  const double later_s = begin_s_ + 6.0;
  const Motion beside = straight_drive(later_s - 2.0, {0.0, 3.0}, 0.0, 8.0, 0.9, 0.5);
  PromiseScene there = nobody(later_s);
  there.moving = {std::make_shared<PredictedDisc>("person", later_s, beside.position(later_s + 4.0),
                                                  Vector2(0.0, 0.0), 0.25, 0.0)};
  const auto around = swerving_.around(on(beside, later_s), there);
  ASSERT_TRUE(around);
  ASSERT_EQ(around->proof, LocalProof::kAsked) << around->message;
  ASSERT_NEAR(around->anchor.place().y(), 3.0, 0.1);
  swerving_.take(later_s, beside, *around);

  const double now_s = later_s + 1.0;
  const Motion stands = standing(now_s - 0.5, ahead_.position(begin_s_), 0.0);
  const auto again =
      swerving_.around({now_s, now_s + kSettle_s, stands, ahead_, false}, scene(now_s, 1.2));
  ASSERT_TRUE(again);
  EXPECT_NEAR(again->anchor.plan_time_s, begin_s_ + default_local_rules().mu_s, 0.1);
}

TEST_F(SwervingTest, IsBackSoonerWhenNobodyIsThereAnyMore) {
  // Who crosses slowly from the right is let pass.
  PromiseScene crossing = scene(begin_s_, 0.0);
  crossing.moving = {std::make_shared<PredictedDisc>("person", begin_s_, Vector2(4.2, -1.0),
                                                     Vector2(-0.1, 0.3), 0.6, 0.0)};
  const auto plan = swerving_.around(on(ahead_, begin_s_), crossing);
  ASSERT_TRUE(plan);
  ASSERT_EQ(plan->proof, LocalProof::kAsked) << plan->message;
  ASSERT_GT(plan->delay_s, 0.4);
  swerving_.take(begin_s_, ahead_, *plan);
  const Motion driven = continued(ahead_, begin_s_, plan->motion.start_time(), plan->motion);
  EXPECT_FALSE(swerving_.sooner(on(driven, begin_s_ + 0.4), nobody(begin_s_ + 0.4))) << "too soon";
  const double now_s = begin_s_ + 0.6;
  Swerving::Situation brakes = on(driven, now_s);
  brakes.follows_plan = false;
  EXPECT_FALSE(swerving_.sooner(brakes, nobody(now_s)));
  const auto sooner = swerving_.sooner(on(driven, now_s), nobody(now_s));
  ASSERT_TRUE(sooner);
  EXPECT_LT(sooner->motion.end_time(), driven.end_time() - 0.2);
  EXPECT_LT((sooner->motion.end_pose().position - ahead_.end_pose().position).norm(), 1e-4);
  const double back_s = plan->rejoins_s + 0.1;
  EXPECT_FALSE(swerving_.sooner(on(driven, back_s), nobody(back_s))) << "is back already";
}

TEST_F(SwervingTest, IsNotDisturbedWhileItCannotBeSooner) {
  const Motion driven = swerved();
  ASSERT_LT(driven.end_time(), ahead_.end_time() + 0.1);
  for (double later_s = 0.6; begin_s_ + later_s < taken_.rejoins_s; later_s += 0.6) {
    const double now_s = begin_s_ + later_s;
    EXPECT_FALSE(swerving_.sooner(on(driven, now_s), scene(now_s, 0.1))) << later_s;
  }
}

TEST_F(SwervingTest, WhatIsHarderIsCalledAnEmergency) {
  int harder = 0;
  for (double apart_s = 0.8; apart_s < 2.5; apart_s += 0.1) {
    PromiseScene close = scene(begin_s_, 0.0);
    close.moving = {std::make_shared<PredictedDisc>("person", begin_s_,
                                                    ahead_.position(begin_s_ + kSettle_s + apart_s),
                                                    Vector2(-0.3, 0.1), 0.25, 0.0)};
    Swerving swerving{robot_, default_local_rules(), [](LocalStage) {}};
    const auto failed = swerving.around(on(ahead_, begin_s_), close);
    ASSERT_TRUE(failed);
    if (failed->proof != LocalProof::kNone || failed->candidates.empty()) continue;
    const LocalPlan found = swerving.harder(on(ahead_, begin_s_), close, *failed);
    EXPECT_GE(found.proof, LocalProof::kEmergency);
    harder += found.proof == LocalProof::kEmergency;
  }
  EXPECT_GT(harder, 0);
}

TEST_F(SwervingTest, FarFromThePlanThereIsNoWayBack) {
  const Motion stands = standing(begin_s_ - 5.0, {3.0, 3.0}, 0.0);
  EXPECT_FALSE(swerving_.around({begin_s_, begin_s_ + kSettle_s, stands, ahead_, false},
                                scene(begin_s_, 0.1)));
}

}  // namespace
}  // namespace mocha
