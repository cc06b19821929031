#include "fleet/protocol/reach.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "world/margin_budget.h"

namespace mocha {
namespace {

/// Of driving beyond the horizon: what is in force until a promise takes over, and braking later
/// than at the horizon where to stop there is in the way of something.
constexpr double kBeyond_s = 2.0;
constexpr double kMost_m = 600.0;  // a message holds no more

std::string number(double value) { return std::to_string(value); }

}  // namespace

Reach Reach::from(const ParameterTable& values, const RobotModel& robot, double horizon_s) {
  const double speed = robot.limits.max_speed;
  Reach reach;
  reach.radio_range_m = values.number("radio_range");
  reach.fleet_speed = values.number("fleet_speed");
  if (speed > reach.fleet_speed) {
    throw std::invalid_argument("fleet_speed = " + number(reach.fleet_speed) +
                                " m/s, allowed is the robot's own " + number(speed) +
                                " m/s or more");
  }
  const double apart_m = 2.0 * robot.footprint.circumscribed_radius_m() + robot.peer_clearance_m +
                         MarginBudget::of(robot).peer_margin_m();
  const double unheard_m = 2.0 * reach.fleet_speed * values.number("reach_timeout");
  const double stopping_m = 0.5 * speed * speed / robot.limits.max_acceleration;
  const double heard_m = 0.5 * (reach.radio_range_m - apart_m - unheard_m);
  const double least_m = speed * kBeyond_s + stopping_m;
  if (heard_m < least_m) {
    throw std::invalid_argument("radio_range = " + number(reach.radio_range_m) + " m, allowed is " +
                                number(2.0 * least_m + apart_m + unheard_m) +
                                " m or more: promises end where unheard robots could be met");
  }
  const double wished_m = speed * (horizon_s + kBeyond_s) + stopping_m;
  reach.promise_m = std::min({heard_m, wished_m, kMost_m});
  return reach;
}

}  // namespace mocha
