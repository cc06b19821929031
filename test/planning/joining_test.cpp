#include "planning/joining.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;

Motion ahead(double start_s) { return straight_drive(start_s, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5); }

TEST(Joining, GoesOverIntoAPlanThatMeetsTheMotion) {
  const Motion committed = ahead(kNow_s);
  const auto onward = joined(committed, ahead(kNow_s), kNow_s + 1.0, kNow_s + 3.0);
  ASSERT_TRUE(onward);
  EXPECT_EQ(onward->start_time(), kNow_s + 1.0);
  for (double t = kNow_s + 1.0; t < onward->end_time(); t += 0.1)
    EXPECT_LT((onward->position(t) - committed.position(t)).norm(), 1e-6);
}

TEST(Joining, NotWherePlaceOrSpeedDiffer) {
  const Motion committed = ahead(kNow_s);
  EXPECT_FALSE(joined(committed, ahead(kNow_s + 0.2), kNow_s + 1.0, kNow_s + 3.0));
  const Motion beside = straight_drive(kNow_s, {0.0, 0.05}, 0.0, 8.0, 0.9, 0.5);
  EXPECT_FALSE(joined(committed, beside, kNow_s + 1.0, kNow_s + 3.0));
}

TEST(Joining, NotIntoATurnInPlace) {
  const Pose here{{0.0, 0.0}, 0.0};
  const Motion turn(kNow_s, {TurnPhase{here, 1.5, 3.0}});
  const Motion stands = standing(kNow_s - 5.0, here.position, here.yaw_rad);
  EXPECT_FALSE(joined(stands, turn, kNow_s + 0.7, kNow_s + 1.0));
  EXPECT_TRUE(joined(stands, turn, kNow_s - 0.3, kNow_s));
}

TEST(Joining, NotIntoAPlanThatIsOver) {
  const Motion committed = ahead(kNow_s);
  const double late_s = committed.end_time() + 1.0;
  EXPECT_FALSE(joined(committed, committed, late_s, late_s + 0.3));
}

TEST(Joining, APlanFromRestCanBePostponedWhereTheRobotStands) {
  const Motion stands = standing(kNow_s - 5.0, {0.0, 0.0}, 0.0);
  const auto later = postponed(stands, ahead(kNow_s - 2.0), kNow_s + 0.3);
  ASSERT_TRUE(later);
  EXPECT_EQ(later->start_time(), kNow_s + 0.3);
  EXPECT_LT((later->end_pose().position - Vector2(8.0, 0.0)).norm(), 1e-6);
  EXPECT_FALSE(postponed(stands, ahead(kNow_s + 1.0), kNow_s + 0.3)) << "not late";
  EXPECT_FALSE(postponed(ahead(kNow_s - 3.0), ahead(kNow_s - 2.0), kNow_s)) << "does not stand";
  const Motion elsewhere = standing(kNow_s - 5.0, {0.0, 0.3}, 0.0);
  EXPECT_FALSE(postponed(elsewhere, ahead(kNow_s - 2.0), kNow_s + 0.3));
}

}  // namespace
}  // namespace mocha
