#include "trajectory/mistiming.h"

#include <gtest/gtest.h>

#include "fleet/protocol/motions.h"
#include "trajectory/separation.h"

namespace mocha {
namespace {

using test::drive;
using test::stand;

TEST(Mistiming, CostsWhatTheSlowerOneDrivesMeanwhile) {
  const Motion slow = drive(10.0, {{0.0, 0.0}, {2.0, 0.0}}, 0.5);
  const Motion fast = drive(11.0, {{0.0, 0.0}, {6.0, 0.0}}, 1.0);
  const Mistiming off = mistiming(slow, fast, 0.1);
  EXPECT_NEAR(off.loss_m, 0.1 * bounds(slow).speed, 1e-9);
  EXPECT_EQ(off.loss_at(10.8), 0.0);
  EXPECT_EQ(off.loss_at(11.0), off.loss_m);
  EXPECT_EQ(off.loss_at(14.05), off.loss_m);
  EXPECT_EQ(off.loss_at(14.2), 0.0);
}

TEST(Mistiming, CostsNothingWhereOneStandsOrTimesAreRight) {
  const Motion drives = drive(10.0, {{0.0, 0.0}, {2.0, 0.0}}, 0.5);
  EXPECT_EQ(mistiming(stand(10.0, {1.0, 0.0}), drives, 0.1).loss_m, 0.0);
  EXPECT_EQ(mistiming(drives, drives, 0.0).loss_m, 0.0);
  EXPECT_EQ(mistiming(drives, drives, -1.0).loss_m, 0.0);
}

/// Whichever of them is early or late, and by how much.
TEST(Mistiming, IsWhatRobotsLoseAtMost) {
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i) {
    const Motion a = test::random_drive(random, 10.0, 4, 2.0);
    const Motion b = test::random_drive(random, 11.0, 4, 2.0);
    const double told_m = closest_approach(a, b, 5.0, 60.0).distance_m;
    const Mistiming off = mistiming(a, b, 0.2);
    for (const double late_s : {-0.2, -0.1, 0.1, 0.2}) {
      const Motion truly(b.start_time() + late_s, b.phases());
      EXPECT_GE(closest_approach(a, truly, 5.0, 60.0).distance_m, told_m - off.loss_m - 2e-3);
    }
  }
}

}  // namespace
}  // namespace mocha
