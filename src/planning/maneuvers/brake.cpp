#include "planning/maneuvers/brake.h"

#include "trajectory/splice.h"

namespace mocha {
namespace {

Maneuvers braking(const ManeuverStart& start, double from_s, double until_s, bool at_once,
                  const Braking& how, const char* words) {
  const double join_s = at_once ? start.emergency_s : start.settled_s;
  return {{join_s, rest_of(start.committed, join_s), from_s, until_s, from_s, how, at_once,
           Follows::kCommitted, words}};
}

}  // namespace

Maneuvers brake_soon(const ManeuverStart& start) {
  const bool at_once = is_alone(start);
  const double brake_s = at_once ? start.emergency_s : start.settled_s;
  return braking(start, brake_s, brake_s, at_once, start.robot.braking(), "brakes");
}

Maneuvers brake_in_time(const ManeuverStart& start) {
  return braking(start, start.settled_s, start.committed.end_time(), false, start.robot.braking(),
                 "brakes in time");
}

Maneuvers brake_in_time_at_once(const ManeuverStart& start) {
  return braking(start, start.emergency_s, start.settled_s, true, start.robot.braking(),
                 "brakes in time");
}

Maneuvers brake_hard(const ManeuverStart& start) {
  return braking(start, start.emergency_s, start.emergency_s, true, start.robot.hard_braking(),
                 "brakes hard");
}

}  // namespace mocha
