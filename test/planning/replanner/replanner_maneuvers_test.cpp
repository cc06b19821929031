// What the rows of the ladder try, of planning/replanner/replanner_maneuvers.cpp.
#include "planning/replanner/replanner_test.h"
#include "safety/certificate.h"
#include "trajectory/splice.h"

namespace mocha {
namespace {

using ReplannerManeuversTest = ReplannerTest;

TEST_F(ReplannerManeuversTest, ProposesAPlanThatJoins) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
  replanner_.set_plan(plan_from(kNow_s + 0.5));
  const auto output = step_on_track(kNow_s);
  ASSERT_TRUE(output.proposal) << output.message;
  EXPECT_EQ(output.row, Row::kFollow) << to_text(output.row);
  EXPECT_FALSE(output.proposal->emergency);
  EXPECT_NEAR(output.proposal->motion.start_time(), kNow_s + 0.5, 1e-6);
  EXPECT_GT(output.proposal->motion.end_pose().position.x(), 1.5);  // the horizon
  EXPECT_LT(output.proposal->motion.end_pose().position.x(), 7.0);
  EXPECT_FALSE(output.request_plan);
}

TEST_F(ReplannerManeuversTest, APlanThatIsNearIsComeBackTo) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.2}, 0.0));
  replanner_.set_plan(plan_from(kNow_s + 0.5));
  const auto near_by = step_on_track(kNow_s);
  ASSERT_TRUE(near_by.proposal) << near_by.message;
  EXPECT_EQ(near_by.row, Row::kDetour) << to_text(near_by.row);
  EXPECT_FALSE(near_by.request_plan);
  const Motion& plan = replanner_.plan();
  EXPECT_EQ(plan.at(plan.start_time()).pose.position, Vector2(0.0, 0.2));
  EXPECT_LT((plan.end_pose().position - Vector2(8.0, 0.0)).norm(), 1e-3);
}

TEST_F(ReplannerManeuversTest, APlanThatDoesNotJoinIsAskedForAgain) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 1.8}, 0.0));
  replanner_.set_plan(plan_from(kNow_s + 0.5));
  const auto elsewhere = step_on_track(kNow_s);
  EXPECT_FALSE(elsewhere.proposal);
  EXPECT_EQ(elsewhere.row, Row::kKeep) << to_text(elsewhere.row);
  EXPECT_TRUE(elsewhere.request_plan);
  EXPECT_TRUE(elsewhere.renew_lease);  // it stands well
  EXPECT_NE(elsewhere.message.find("does not join"), std::string::npos);
}

TEST_F(ReplannerManeuversTest, APlanFromRestThatCameLateIsDrivenLater) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
  for (const double late_s : {0.1, 1.0, 60.0}) {
    const Motion plan = straight_drive(kNow_s - late_s, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5);
    LocalReplanner replanner(robot_, options_, default_local_options());
    replanner.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
    replanner.set_plan(plan);
    const auto output = replanner.step(kNow_s, {kNow_s, {{0.0, 0.0}, 0.0}, {0.0, 0.0}}, scene_);
    ASSERT_TRUE(output.proposal) << output.message;
    EXPECT_EQ(output.row, Row::kFollow) << to_text(output.row);
    const Motion& motion = output.proposal->motion;
    EXPECT_NEAR(motion.start_time(), kNow_s + options_.settle_s, 1e-6);
    for (double t = 0.0; t < 3.0; t += 0.1) {
      const Vector2 expected = plan.at(plan.start_time() + t).pose.position;
      EXPECT_LT((motion.at(motion.start_time() + t).pose.position - expected).norm(), 1e-5);
    }
  }
}

TEST_F(ReplannerManeuversTest, FromRestItFindsIntoAPlanThatIsOnTheMove) {
  const Motion rolling = rest_of(ahead_, kNow_s + 3.0);
  replanner_.set_committed(1, standing(kNow_s, rolling.at(kNow_s + 3.0).pose.position, 0.0));
  replanner_.set_plan(rolling);
  const auto output = step_on_track(kNow_s + 4.0);
  ASSERT_TRUE(output.proposal) << output.message;
  EXPECT_EQ(output.row, Row::kDetour) << to_text(output.row);
  EXPECT_TRUE(output.proposal->motion.at(kNow_s).at_rest);
  EXPECT_FALSE(check_limits(output.proposal->motion, robot_.limits, kNow_s));
}

TEST_F(ReplannerManeuversTest, WhatLeadsNowhereIsNotProposed) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {-0.005, 0.0}, 0.0));
  replanner_.set_plan(straight_drive(kNow_s + 0.5, {-0.005, 0.0}, 0.0, 8.0, 0.9, 0.5));
  OccupancyGrid grid = open_;
  fill_box(grid, {0.3, -3.0}, {12.0, 3.0}, OccupancyGrid::kUnknown);
  scene_ = scene_of(grid);
  const auto output = step_on_track(kNow_s);
  EXPECT_FALSE(output.proposal);
  EXPECT_EQ(output.row, Row::kKeep) << to_text(output.row);
  EXPECT_TRUE(output.renew_lease);
  EXPECT_TRUE(output.request_plan);
  EXPECT_EQ(output.violation.term, ViolatedTerm::kUnseenSpace);
  EXPECT_NE(output.message.find("not seen free"), std::string::npos) << output.message;
}

TEST_F(ReplannerManeuversTest, ExtendsOnlyWhenEnoughIsUsedUp) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
  replanner_.set_plan(plan_from(kNow_s + 0.5));
  const auto first = step_on_track(kNow_s);
  ASSERT_TRUE(first.proposal);
  replanner_.set_committed(first.proposal->sequence, first.proposal->motion);
  EXPECT_EQ(step_on_track(kNow_s + 0.6).row, Row::kKeep);
  const auto second = step_on_track(kNow_s + options_.extend_every_s + 0.1);
  ASSERT_TRUE(second.proposal);
  EXPECT_EQ(second.row, Row::kFollow) << to_text(second.row);
  EXPECT_GT(second.proposal->sequence, first.proposal->sequence);
  EXPECT_GT(second.proposal->motion.end_pose().position.x(),
            first.proposal->motion.end_pose().position.x() + 0.5);
}

TEST_F(ReplannerManeuversTest, APlanThatIsNotLateKeepsItsTimes) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {0.0, 0.0}, 0.0));
  replanner_.set_plan(plan_from(kNow_s + 1.0));
  const auto output = step_on_track(kNow_s);
  ASSERT_TRUE(output.proposal) << output.message;
  EXPECT_NEAR(output.proposal->motion.start_time(), kNow_s + 1.0, 1e-6);
}

TEST_F(ReplannerManeuversTest, ALatePlanIsNotDrivenLaterFromElsewhereOrOnTheMove) {
  const Motion elsewhere = standing(kNow_s - 5.0, {0.0, 1.8}, 0.0);
  const Motion on_the_move = rest_of(plan_from(kNow_s - 4.0), kNow_s - 1.0);
  for (const Motion& committed : {elsewhere, on_the_move}) {
    LocalReplanner replanner(robot_, options_, default_local_options());
    replanner.set_committed(1, committed);
    replanner.set_plan(straight_drive(kNow_s - 2.0, {0.0, 0.0}, 0.0, 20.0, 0.9, 0.5));
    const auto output = replanner.step(kNow_s, state(committed, kNow_s), scene_);
    EXPECT_NE(output.row, Row::kFollow);
    EXPECT_EQ(output.proposal.has_value(), output.row == Row::kDetour) << to_text(output.row);
  }
}

TEST_F(ReplannerManeuversTest, APlanThatIsOverIsNotPromised) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {8.0, 0.0}, 0.0));
  replanner_.set_plan(plan_from(kNow_s - 60.0));
  const auto output = step_on_track(kNow_s);
  EXPECT_EQ(output.row, Row::kKeep) << to_text(output.row);
  EXPECT_FALSE(output.proposal);
}

TEST_F(ReplannerManeuversTest, ADetourThatLeadsNowhereIsNotProposed) {
  replanner_.set_committed(1, standing(kNow_s - 5.0, {0.012, 0.2}, 0.0));
  replanner_.set_plan(plan_from(kNow_s + 0.5));
  OccupancyGrid grid = open_;
  fill_box(grid, {0.35, -3.0}, {12.0, 3.0}, OccupancyGrid::kUnknown);
  scene_ = scene_of(grid);
  const auto output = step_on_track(kNow_s);
  ASSERT_TRUE(output.local);
  EXPECT_EQ(output.local->reason, PlanReason::kSolved) << output.local->message;
  EXPECT_FALSE(output.proposal);
  EXPECT_FALSE(output.swerves);
  EXPECT_TRUE(output.request_plan);
}

}  // namespace
}  // namespace mocha
