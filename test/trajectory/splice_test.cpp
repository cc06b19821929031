#include "trajectory/splice.h"

#include <gtest/gtest.h>

#include <random>

#include "trajectory/random_motion.h"
#include "trajectory/simple_motions.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;

Motion ahead(double start_s) { return straight_drive(start_s, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5); }

DrivePhase drive_of(const Motion& motion) { return std::get<DrivePhase>(motion.phases().front()); }

/// Forward along x, then a turn to the left, then forward along y; ends at (4, 3).
Motion with_corner(double start_s) {
  const DrivePhase along = drive_of(straight_drive(0.0, {0.0, 0.0}, 0.0, 4.0, 0.9, 0.5));
  const DrivePhase up = drive_of(straight_drive(0.0, {4.0, 0.0}, M_PI / 2.0, 3.0, 0.9, 0.5));
  return Motion(start_s, {along, TurnPhase{{{4.0, 0.0}, 0.0}, M_PI / 2.0, 2.0}, up});
}

void expect_same(const Motion& motion, const Motion& expected, double from_s, double until_s,
                 double shift_s = 0.0) {
  for (double t = from_s; t < until_s; t += 0.05) {
    const MotionState there = motion.at(t + shift_s);
    const MotionState state = expected.at(t);
    EXPECT_LT((there.pose.position - state.pose.position).norm(), 1e-5) << t - from_s;
    EXPECT_LT((there.velocity - state.velocity).norm(), 1e-5) << t - from_s;
    EXPECT_LT(std::abs(wrap_angle(there.pose.yaw_rad - state.pose.yaw_rad)), 1e-4) << t - from_s;
  }
}

TEST(Splice, GoesOverIntoAMotionThatMeetsTheFirst) {
  const Motion committed = ahead(kNow_s);
  const auto onward = splice(committed, kNow_s + 1.0, kNow_s + 3.0, ahead(kNow_s));
  ASSERT_TRUE(onward) << describe(onward.fault);
  EXPECT_EQ(onward.motion.start_time(), kNow_s + 1.0);
  EXPECT_NEAR(onward.motion.end_time(), committed.end_time(), 1e-6);
  expect_same(onward.motion, committed, kNow_s + 1.0, committed.end_time());
}

TEST(Splice, IsTheFirstUntilItJoinsAndThenTheSecond) {
  int drives = 0;
  for (int seed = 0; seed < 20; ++seed) {
    const Motion first =
        within(random_drive(seed, 8, seed % 2 == 0 ? 1 : -1), {1.0, 0.8, 1.5}, kNow_s);
    const double join_s = kNow_s + (0.1 + 0.04 * seed) * (first.end_time() - kNow_s);
    const Motion second(join_s, brake_along(first, join_s, Braking(0.5)));
    const double from_s = kNow_s + 0.05 * seed;
    const auto whole = splice(first, from_s, join_s, second);
    ASSERT_TRUE(whole) << seed << ": " << describe(whole.fault);
    EXPECT_EQ(whole.motion.start_time(), from_s);
    EXPECT_NEAR(whole.motion.end_time(), second.end_time(), 1e-6);
    expect_same(whole.motion, first, from_s, join_s);
    expect_same(whole.motion, second, join_s, second.end_time());
    ++drives;
  }
  EXPECT_EQ(drives, 20);
}

TEST(Splice, NotWherePlaceHeadingOrSpeedDiffer) {
  const Motion committed = ahead(kNow_s);
  const double join_s = kNow_s + 3.0;
  const auto fault = [&](const Motion& second) {
    const auto onward = splice(committed, kNow_s + 1.0, join_s, second);
    EXPECT_EQ(onward.motion.empty(), onward.fault != MotionFault::kNone);
    return onward.fault;
  };
  EXPECT_EQ(fault(ahead(kNow_s + 0.2)), MotionFault::kPositionJump);
  EXPECT_EQ(fault(straight_drive(kNow_s, {0.0, 0.05}, 0.0, 8.0, 0.9, 0.5)),
            MotionFault::kPositionJump);
  // At the same place then, but slower, or standing.
  const DrivePhase slow{1, drive_of(committed).path.stretched(1.1)};
  EXPECT_EQ(fault(Motion(kNow_s - 0.3, {slow})), MotionFault::kVelocityJump);
  const Vector2 place = committed.position(join_s);
  EXPECT_EQ(fault(standing(join_s, place, 0.0)), MotionFault::kVelocityJump);
  EXPECT_EQ(fault(standing(join_s, place, 0.1)), MotionFault::kHeadingJump);
}

TEST(Splice, ATurnInPlaceIsLeftOnlyAtItsRate) {
  const Pose here{{0.0, 0.0}, 0.0};
  const Motion turn(kNow_s, {TurnPhase{here, 1.5, 3.0}});
  const Motion before = standing(kNow_s - 5.0, here.position, here.yaw_rad);
  EXPECT_EQ(splice(before, kNow_s + 0.7, kNow_s + 1.0, turn).fault, MotionFault::kHeadingJump);
  EXPECT_TRUE(splice(before, kNow_s - 0.3, kNow_s, turn));
  EXPECT_TRUE(splice(before, kNow_s - 3.0, kNow_s - 2.0, turn)) << "stands until it turns";
  const Motion stays = standing(kNow_s, here.position, turn.at(kNow_s + 1.0).pose.yaw_rad);
  EXPECT_EQ(splice(turn, kNow_s, kNow_s + 1.0, stays).fault, MotionFault::kYawRateJump);
  const Motion stops(kNow_s + 1.0, brake_along(turn, kNow_s + 1.0, Braking(1.0, 2.0, 4.0)));
  const auto stopped = splice(turn, kNow_s + 0.5, kNow_s + 1.0, stops);
  ASSERT_TRUE(stopped) << describe(stopped.fault);
  expect_same(stopped.motion, turn, kNow_s + 0.5, kNow_s + 1.0);
  const auto turned =
      splice(turn, kNow_s + 1.0, kNow_s + 3.0, standing(kNow_s, here.position, 1.5));
  ASSERT_TRUE(turned) << describe(turned.fault);
  EXPECT_EQ(turned.motion.start_time(), kNow_s + 1.0);
  expect_same(turned.motion, turn, kNow_s + 1.0, kNow_s + 4.0);
}

TEST(Splice, EachStandsBeforeItsStartAndAfterItsEnd) {
  const Motion first = straight_drive(kNow_s, {-2.0, 0.0}, 0.0, 2.0, 0.5, 0.5);
  const Motion second = ahead(kNow_s + 20.0);
  const auto waits = splice(first, kNow_s + 1.0, kNow_s + 15.0, second);
  ASSERT_TRUE(waits) << describe(waits.fault);
  expect_same(waits.motion, first, kNow_s + 1.0, kNow_s + 15.0);
  expect_same(waits.motion, second, kNow_s + 15.0, second.end_time() + 1.0);
  // The second may be the first to begin.
  const Motion later = standing(kNow_s + 30.0, {0.0, 0.0}, 0.0);
  const auto sooner = splice(later, kNow_s + 5.0, kNow_s + 20.0, second);
  ASSERT_TRUE(sooner) << describe(sooner.fault);
  EXPECT_EQ(sooner.motion.start_time(), kNow_s + 20.0);
  expect_same(sooner.motion, second, kNow_s + 20.0, second.end_time());
}

TEST(Splice, IntoWhatIsOverItIsTheFirstToItsEnd) {
  const Motion committed = ahead(kNow_s);
  const double late_s = committed.end_time() + 1.0;
  const auto over = splice(committed, kNow_s + 1.0, late_s, committed);
  ASSERT_TRUE(over) << describe(over.fault);
  expect_same(over.motion, committed, kNow_s + 1.0, late_s + 1.0);
  const Motion elsewhere = straight_drive(kNow_s, {0.0, 0.5}, 0.0, 8.0, 0.9, 0.5);
  EXPECT_EQ(splice(committed, kNow_s + 1.0, late_s, elsewhere).fault, MotionFault::kPositionJump);
  EXPECT_EQ(splice(committed, kNow_s + 1.0, kNow_s + 3.0, standing(0.0, {8.0, 0.0}, 0.0)).fault,
            MotionFault::kPositionJump);
}

/// As a detour comes back to its plan, later or sooner than the plan is there.
TEST(Splice, AfterAHeadTheTailIsShiftedInTime) {
  const Motion plan = with_corner(kNow_s);
  const double begin_s = kNow_s + 100.0;
  for (const double back_s : {2.0, 3.5, plan.phase_start_time(2) - kNow_s + 1.0}) {
    const auto whole =
        splice(begin_s, plan.phases_between(kNow_s + 1.0, kNow_s + back_s), plan, kNow_s + back_s);
    ASSERT_TRUE(whole) << describe(whole.fault);
    EXPECT_EQ(whole.motion.start_time(), begin_s);
    expect_same(whole.motion, plan, kNow_s + 1.0, plan.end_time(), 99.0);
  }
  // Up to the end of the plan nothing is left of it.
  const auto head_only =
      splice(begin_s, plan.phases_between(kNow_s + 1.0, plan.end_time()), plan, plan.end_time());
  ASSERT_TRUE(head_only) << describe(head_only.fault);
  EXPECT_NEAR(head_only.motion.end_time(), plan.end_time() + 99.0, 1e-5);
  EXPECT_EQ(head_only.motion.phases().size(), 3u);
}

TEST(Splice, AHeadThatEndsElsewhereIsRefused) {
  const Motion plan = with_corner(kNow_s);
  const auto fault = [&](double head_until_s, double tail_from_s) {
    return splice(kNow_s, plan.phases_between(kNow_s, head_until_s), plan, tail_from_s).fault;
  };
  EXPECT_EQ(fault(kNow_s + 2.5, kNow_s + 3.0), MotionFault::kPositionJump);
  EXPECT_NE(fault(kNow_s + 3.0, plan.phase_start_time(1) + 0.5), MotionFault::kNone);
  EXPECT_EQ(fault(kNow_s + 3.0, plan.end_time() + 1.0), MotionFault::kPositionJump);
  EXPECT_EQ(fault(kNow_s + 3.0, kNow_s + 3.0), MotionFault::kNone);
  EXPECT_EQ(splice(std::nan(""), {}, plan, kNow_s).fault, MotionFault::kStartTime);
}

TEST(Splice, WithoutAHeadItIsTheTailOnly) {
  const Motion plan = with_corner(kNow_s);
  const auto whole = splice(kNow_s + 50.0, {}, plan, kNow_s + 2.0);
  ASSERT_TRUE(whole) << describe(whole.fault);
  expect_same(whole.motion, plan, kNow_s + 2.0, plan.end_time(), 48.0);
  const auto stands = splice(kNow_s + 50.0, {}, plan, plan.end_time() + 3.0);
  ASSERT_TRUE(stands) << describe(stands.fault);
  EXPECT_EQ(stands.motion.length_m(), 0.0);
  EXPECT_LT((stands.motion.end_pose().position - Vector2(4.0, 3.0)).norm(), 1e-9);
}

TEST(RestOf, IsWhatIsLeft) {
  const Motion motion = ahead(kNow_s);
  const Motion rest = rest_of(motion, kNow_s + 3.0);
  EXPECT_EQ(rest.start_time(), kNow_s + 3.0);
  EXPECT_NEAR(rest.end_time(), motion.end_time(), 1e-6);
  for (double t = kNow_s + 3.0; t < motion.end_time(); t += 0.1) {
    EXPECT_LT((rest.at(t).pose.position - motion.at(t).pose.position).norm(), 1e-6);
  }
  EXPECT_EQ(rest_of(motion, kNow_s - 3.0).start_time(), kNow_s) << "nothing was before";
  const Motion nothing = rest_of(motion, motion.end_time() + 5.0);
  EXPECT_EQ(nothing.start_time(), motion.end_time() + 5.0);
  EXPECT_LT((nothing.end_pose().position - Vector2(8.0, 0.0)).norm(), 1e-9);
}

}  // namespace
}  // namespace mocha
