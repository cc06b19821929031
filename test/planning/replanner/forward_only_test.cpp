// A base that cannot drive backward, before somebody from whom another one backs off.
#include <gtest/gtest.h>

#include "planning/street.h"

namespace mocha {
namespace {

/// In a corridor too narrow to pass, somebody walks towards the robot.
Street head_on(double ahead_m, double walks_mps, bool can_reverse) {
  OccupancyGrid corridor = free_grid({-10.0, -3.0}, {10.0, 3.0});
  fill_box(corridor, {-10.0, 0.9}, {10.0, 3.0});
  fill_box(corridor, {-10.0, -3.0}, {10.0, -0.9});
  RobotModel robot = rover();
  robot.limits.can_reverse = can_reverse;
  return Street(corridor, {8.0, 0.0}, {{{ahead_m, 0.0}, {{10.0, {-walks_mps, 0.0}}}}}, robot);
}

TEST(ForwardOnly, TurnsAwayWhereAnotherBaseBacksOff) {
  for (const double ahead_m : {4.0, 6.0}) {
    SCOPED_TRACE(ahead_m);
    Street reversing = head_on(ahead_m, 0.3, true);
    reversing.run(15.0);
    EXPECT_LT(reversing.least_speed, -0.5);
    Street forward = head_on(ahead_m, 0.3, false);
    forward.run(15.0);
    EXPECT_EQ(forward.least_speed, 0.0);
    EXPECT_GT(forward.least_gap_m, 0.1);
  }
}

TEST(ForwardOnly, WhereItCannotGetAwayInTimeItStands) {
  for (const double walks_mps : {0.5, 0.8}) {
    SCOPED_TRACE(walks_mps);
    Street forward = head_on(2.0, walks_mps, false);
    forward.run(15.0);
    EXPECT_EQ(forward.least_speed, 0.0);
    EXPECT_LT(forward.contact_speed, 0.05);
  }
}

}  // namespace
}  // namespace mocha
