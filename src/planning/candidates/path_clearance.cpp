#include "planning/candidates/path_clearance.h"

#include <algorithm>

#include "world/margin_budget.h"

namespace mocha {

double path_clearance_m(const RobotModel& robot) {
  double radius_m = 0.0;
  for (const auto& disc : robot.footprint.cover()) radius_m = std::max(radius_m, disc.radius_m);
  return radius_m + MarginBudget::of(robot).static_margin_m() + kPathSlack_m;
}

}  // namespace mocha
