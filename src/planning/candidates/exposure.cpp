#include "planning/candidates/exposure.h"

#include <algorithm>
#include <limits>

#include "safety/leaving.h"
#include "trajectory/stopping.h"

namespace mocha {

Violation conflict_of(const Motion& plan, const std::vector<MovingThing>& moving,
                      double own_radius_m, double from_s, double mu_pre_s) {
  Violation first;
  for (const MovingThing& thing : moving) {
    const double until_s = std::min(from_s + mu_pre_s, thing.until_s);
    if (until_s <= from_s) continue;
    const Violation violation = check_separation_or_leaving(
        plan, own_radius_m, *thing.obstacle, thing.keep_m - own_radius_m, from_s, until_s);
    if (violation && (!first || violation.time_s < first.time_s)) first = violation;
  }
  return first;
}

std::vector<MovingThing> foreseen(std::vector<MovingThing> things) {
  for (MovingThing& thing : things) {
    if (std::isinf(thing.obstacle->rest_time())) thing.until_s = thing.obstacle->rest_time();
  }
  return things;
}

double least_room_m(const Motion& motion, const std::vector<MovingThing>& moving, double from_s,
                    double until_s, double of_no_use_m) {
  constexpr double kStep_s = 0.1;
  constexpr double kSoon_s = 4.0;
  constexpr double kLaterStep_s = 0.4;  // mostly, what is looked at has come to rest by then
  double least_m = std::numeric_limits<double>::infinity();
  for (double t = from_s; t < until_s && least_m >= of_no_use_m;
       t += t < from_s + kSoon_s ? kStep_s : kLaterStep_s) {
    const Vector2 place = motion.position(t);
    for (const MovingThing& thing : moving) {
      if (t > thing.until_s) continue;
      const MovingObstacle::Disc disc = thing.obstacle->at(t);
      least_m = std::min(least_m, (place - disc.centre).norm() - disc.radius_m - thing.keep_m);
    }
  }
  return least_m;
}

std::vector<MovingThing> exposed_to(const ManeuverStart& start, double from_s) {
  const Motion& committed = start.committed;
  const Motion stop = with_brake(committed, from_s, from_s, start.robot.hard_braking());
  Requirement required = start.requirements[RequirementName::kPromise].from(from_s);
  required.course = start.course;
  std::vector<MovingThing> things = kept_apart(start.scene, required);
  const std::vector<MovingThing> for_good = foreseen(things);
  for (std::size_t i = 0; i < things.size(); ++i) {
    const auto meets = [&](const Motion& motion) {
      return least_room_m(motion, {things[i]}, from_s, start.scene.predicted_until_s, 0.0) < 0.0;
    };
    if (meets(committed) || meets(stop)) things[i] = for_good[i];
  }
  return things;
}

}  // namespace mocha
