#include "planning/candidates/path_clearance.h"

#include "world/margin_budget.h"

namespace mocha {

double path_clearance_m(const RobotModel& robot) {
  return robot.footprint.inscribed_radius_m() + MarginBudget::of(robot).static_margin().still_m +
         kPathSlack_m;
}

double passable_gap_m(const RobotModel& robot) { return 2.0 * path_clearance_m(robot); }

double turning_room_m(const RobotModel& robot) {
  return 2.0 * (robot.footprint.cover_reach_m() + MarginBudget::of(robot).static_margin().still_m);
}

}  // namespace mocha
