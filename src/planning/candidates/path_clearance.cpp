#include "planning/candidates/path_clearance.h"

#include "world/margin_budget.h"

namespace mocha {

double path_clearance_m(const RobotModel& robot) {
  return robot.footprint.inscribed_radius_m() + MarginBudget::of(robot).static_margin_m() +
         kPathSlack_m;
}

}  // namespace mocha
