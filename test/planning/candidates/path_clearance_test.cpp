#include "planning/candidates/path_clearance.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"
#include "safety/certificate.h"
#include "safety/circle_field.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

/// A straight drive past a post, slowly, so far from its surface.
bool is_certified(const RobotModel& robot, double distance_m) {
  const CircleField post({{{2.0, 0.5 + distance_m}, 0.5}});
  const Motion drive =
      slowed(straight_drive(0.0, {0.0, 0.0}, 0.0, 4.0, 0.5, 0.5), 0.5 / kCreep_mps);
  return !check_clearance(drive, robot.footprint, post, MarginBudget::of(robot).static_margin(),
                          0.0);
}

TEST(PathClearance, IsWhatADriveAlongThePathNeedsAndALittleMore) {
  for (const RobotModel& robot : {rover(), jackal()}) {
    EXPECT_TRUE(is_certified(robot, path_clearance_m(robot))) << robot.name;
    EXPECT_FALSE(is_certified(robot, path_clearance_m(robot) - 2.0 * kPathSlack_m)) << robot.name;
  }
}

}  // namespace
}  // namespace mocha
