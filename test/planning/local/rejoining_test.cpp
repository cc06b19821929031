#include "planning/local/rejoining.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"

namespace mocha {
namespace {

constexpr double kStart_s = 1.7e9;

/// Forward along x, then a turn to the left, then forward along y; ends at (4, 3).
Motion with_corner() {
  const DrivePhase along =
      std::get<DrivePhase>(straight_drive(0.0, {0.0, 0.0}, 0.0, 4.0, 0.9, 0.5).phases().front());
  const DrivePhase up = std::get<DrivePhase>(
      straight_drive(0.0, {4.0, 0.0}, M_PI / 2.0, 3.0, 0.9, 0.5).phases().front());
  return Motion(kStart_s, {along, TurnPhase{{{4.0, 0.0}, 0.0}, M_PI / 2.0, 2.0}, up});
}

Motion backward(double length_m) {
  auto drive = std::get<DrivePhase>(
      straight_drive(0.0, {0.0, 0.0}, M_PI, length_m, 0.5, 0.5).phases().front());
  drive.direction = -1;
  return Motion(kStart_s, {drive});
}

TEST(ProgressOn, IsWhereThePlanIsNearest) {
  const Motion plan = straight_drive(kStart_s, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5);
  for (const double t : {1.0, 3.0, 6.0}) {
    const Vector2 beside = plan.at(kStart_s + t).pose.position + Vector2(0.0, 0.4);
    EXPECT_NEAR(*progress_on(plan, beside, plan.start_time(), 1.0), kStart_s + t, 0.2) << t;
    EXPECT_FALSE(progress_on(plan, beside, plan.start_time(), 0.3)) << t;
    EXPECT_GE(*progress_on(plan, beside, kStart_s + t + 0.3, 1.0), kStart_s + t + 0.3);
  }
  EXPECT_FALSE(progress_on(plan, {0.0, 0.0}, plan.end_time() + 1.0, 1.0));
  EXPECT_FALSE(progress_on(plan, {std::nan(""), 0.0}, plan.start_time(), 1.0));
}

TEST(ProgressOn, OfPlacesAboutAsNearIsTheEarliest) {
  // Comes back to where it was.
  const auto there =
      std::get<DrivePhase>(straight_drive(0.0, {0.0, 0.0}, 0.0, 4.0, 0.9, 0.5).phases().front());
  auto back =
      std::get<DrivePhase>(straight_drive(0.0, {4.0, 0.0}, M_PI, 4.0, 0.9, 0.5).phases().front());
  back.direction = -1;
  const Motion plan(kStart_s, {there, back});
  const double first_s = *progress_on(plan, {2.0, 0.3}, kStart_s, 1.0);
  EXPECT_LT(first_s, plan.phase_start_time(1));
  EXPECT_GT(*progress_on(plan, {2.0, 0.3}, first_s + 1.5, 1.0), plan.phase_start_time(1));
}

TEST(RejoinPoint, IsSoFarAheadInTheStateOfThePlan) {
  const Motion plan = straight_drive(kStart_s, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5);
  const auto point = find_rejoin_point(plan, kStart_s + 2.0, 3.0);
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->plan_time_s, kStart_s + 5.0, 1e-6);
  EXPECT_NEAR(point->drive_s, 3.0, 1e-6);
  const MotionState there = plan.at(kStart_s + 5.0);
  EXPECT_LT((point->state.col(0) - there.pose.position).norm(), 1e-6);
  EXPECT_LT((point->state.col(1) - there.velocity).norm(), 1e-6);
  EXPECT_LT((point->state.col(2) - there.acceleration).norm(), 1e-6);
}

TEST(RejoinPoint, IsNoFartherThanTheDriveGoes) {
  const Motion plan = with_corner();
  const double corner_s = plan.phase_start_time(1);
  for (const double before_s : {5.0, 3.0, 1.0, 0.5}) {
    const auto point = find_rejoin_point(plan, corner_s - before_s, before_s - 0.3);
    ASSERT_TRUE(point) << before_s;
    EXPECT_NEAR(point->plan_time_s, corner_s, 1e-6) << before_s;  // almost there: to the end
    EXPECT_NEAR(point->drive_s, before_s, 1e-6) << before_s;
    EXPECT_LT(point->state.col(1).norm(), 1e-6) << before_s;
    EXPECT_NEAR(find_rejoin_point(plan, corner_s - before_s, 60.0)->plan_time_s, corner_s, 1e-6);
  }
}

TEST(RejoinPoint, LeavesOutTheTurnThatComesNext) {
  const Motion plan = with_corner();
  const double up_s = plan.phase_start_time(2);
  for (const double progress_s : {plan.phase_start_time(1) - 0.2, up_s - 1.0, up_s}) {
    const auto point = find_rejoin_point(plan, progress_s, 2.0);
    ASSERT_TRUE(point);
    EXPECT_NEAR(point->plan_time_s, up_s + 2.0, 1e-6);
    EXPECT_NEAR(point->drive_s, 2.0, 1e-6);
  }
}

TEST(RejoinPoint, IsNoneWhereThePlanDrivesBackwardOrNotAtAll) {
  EXPECT_FALSE(find_rejoin_point(backward(2.0), kStart_s, 3.0));
  EXPECT_FALSE(find_rejoin_point(standing(kStart_s, {0.0, 0.0}, 0.0), kStart_s, 3.0));
  EXPECT_FALSE(find_rejoin_point(Motion(), kStart_s, 3.0));
  const Motion plan = with_corner();
  EXPECT_FALSE(find_rejoin_point(plan, plan.end_time() - 0.2, 3.0));
  EXPECT_FALSE(find_rejoin_point(plan, plan.end_time() + 9.0, 3.0));
}

}  // namespace
}  // namespace mocha
