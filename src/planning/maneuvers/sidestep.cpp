#include "planning/maneuvers/sidestep.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planning/candidates/exposure.h"
#include "trajectory/stopping.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

constexpr double kDistances_m[] = {0.4, 0.8, 1.3, 2.0};
constexpr int kDirections = 24;
constexpr std::size_t kMost = 10;
// Enough room is enough; of those that have it, the one that is soonest done is the best.
constexpr double kEnoughRoom_m = 0.05;
constexpr double kNoTurn_rad = 0.005;
constexpr double kShareOfLimits = 0.95;
// So far ahead a sidestep looks at what is in the way: to step straight back is to be met again
// soon, to step aside is not.
constexpr double kSidestepForeseen_s = 15.0;

/// Straight along the heading (direction +1) or against it, from rest to rest: the cubic, which
/// sets off with all its acceleration.
DrivePhase straight(const Pose& from, double direction, double length_m,
                    const MotionLimits& limits) {
  const Vector2 step =
      direction * length_m * Vector2(std::cos(from.yaw_rad), std::sin(from.yaw_rad));
  PlanarPath::Piece piece = PlanarPath::Piece::Zero();
  piece.col(0) = from.position;
  piece.col(2) = 3.0 * step;
  piece.col(3) = -2.0 * step;
  // Its highest speed is 3/2 of the mean, its highest acceleration 6 length / time^2.
  const double duration_s =
      std::max(1.5 * length_m / (kShareOfLimits * limits.max_speed),
               std::sqrt(6.0 * length_m / (kShareOfLimits * limits.max_acceleration)));
  return {direction > 0.0 ? 1 : -1, PlanarPath({piece}, {duration_s})};
}

/// Turns by the smaller angle, so that either the front or the back points to the place; always the
/// front, where the robot must not drive backward.
std::vector<Phase> step_to(const Pose& from, const Vector2& place, const MotionLimits& limits,
                           bool may_back) {
  const Vector2 path = place - from.position;
  const double ahead = wrap_angle(std::atan2(path.y(), path.x()) - from.yaw_rad);
  const double direction = std::abs(ahead) <= 0.5 * M_PI || !may_back ? 1.0 : -1.0;
  const double change = direction > 0.0 ? ahead : wrap_angle(ahead + M_PI);
  Pose faced = from;
  std::vector<Phase> phases;
  if (std::abs(change) > kNoTurn_rad) {
    phases.emplace_back(TurnPhase{
        from, change, turn_duration_s(change, limits.max_yaw_rate, limits.max_yaw_acceleration)});
    faced.yaw_rad = wrap_angle(from.yaw_rad + change);
  }
  phases.emplace_back(straight(faced, direction, path.norm(), limits));
  return phases;
}

bool stands_free(const Vector2& from, const Vector2& to, const ManeuverStart& start) {
  const double clear_m = start.robot.footprint.circumscribed_radius_m() +
                         MarginBudget::of(start.robot).static_margin_m();
  for (double share = 0.25; share <= 1.0; share += 0.25) {
    if (start.scene.obstacles->distance_bound(from + share * (to - from)) < clear_m) return false;
  }
  return true;
}

/// What may come near a place of a sidestep, or of the braking before it, in time.
std::vector<MovingThing> within_reach(const std::vector<MovingThing>& moving, const Vector2& stop,
                                      double brake_m, double from_s, double until_s) {
  const double reach_m =
      *std::max_element(std::begin(kDistances_m), std::end(kDistances_m)) + kEnoughRoom_m + brake_m;
  std::vector<MovingThing> near;
  for (const MovingThing& thing : moving) {
    const MovingObstacle::Disc disc = thing.obstacle->at(from_s);
    const double comes_m =
        thing.obstacle->max_closing_speed(from_s) * std::max(0.0, until_s - from_s);
    if ((disc.centre - stop).norm() <= disc.radius_m + thing.keep_m + reach_m + comes_m)
      near.push_back(thing);
  }
  return near;
}

struct Step {
  double room_m;
  Motion motion;
};

/// The steps from where the robot comes to rest, to all sides.
std::vector<Step> steps(const ManeuverStart& start, double join_s, const std::vector<Phase>& brake,
                        const MotionLimits& limits) {
  const Pose stop = Motion(join_s, brake).end_pose();
  const double until_s = join_s + kSidestepForeseen_s;
  const double brake_m = (start.committed.position(join_s) - stop.position).norm();
  const std::vector<MovingThing> near =
      within_reach(exposed_to(start, join_s), stop.position, brake_m, join_s, until_s);
  std::vector<Step> steps;
  for (const double distance_m : kDistances_m) {
    for (int i = 0; i < kDirections; ++i) {
      const double angle = stop.yaw_rad + 2.0 * M_PI * i / kDirections;
      const Vector2 place = stop.position + distance_m * Vector2(std::cos(angle), std::sin(angle));
      if (!stands_free(stop.position, place, start)) continue;
      std::vector<Phase> phases = brake;
      for (const Phase& phase : step_to(stop, place, limits, start.robot.may_back()))
        phases.push_back(phase);
      Motion motion(join_s, std::move(phases));
      const double room_m = least_room_m(motion, near, join_s, until_s);
      steps.push_back({std::min(room_m, kEnoughRoom_m), std::move(motion)});
    }
  }
  return steps;
}

Maneuvers best_steps(const ManeuverStart& start, bool at_once, const Braking& braking,
                     const MotionLimits& limits, const char* words) {
  const double join_s = at_once ? start.emergency_s : start.settled_s;
  std::vector<Step> choices =
      steps(start, join_s, brake_along(start.committed, join_s, braking), limits);
  std::stable_sort(choices.begin(), choices.end(), [](const Step& a, const Step& b) {
    return a.room_m != b.room_m ? a.room_m > b.room_m : a.motion.end_time() < b.motion.end_time();
  });
  if (choices.size() > kMost) choices.resize(kMost);
  Maneuvers maneuvers;
  for (Step& choice : choices)
    maneuvers.push_back(whole(std::move(choice.motion), join_s, at_once, words));
  return maneuvers;
}

}  // namespace

Maneuvers sidesteps(const ManeuverStart& start) {
  return best_steps(start, false, start.robot.braking(), start.robot.limits, "steps aside");
}

Maneuvers hard_sidesteps(const ManeuverStart& start) {
  constexpr const char* kWords = "steps aside, which keeps the most room";
  MotionLimits limits = start.robot.limits;
  limits.max_acceleration = start.robot.hard_braking().deceleration();
  Maneuvers maneuvers = best_steps(start, false, start.robot.braking(), limits, kWords);
  if (!is_alone(start)) return maneuvers;
  for (Maneuver& each : best_steps(start, true, start.robot.hard_braking(), limits, kWords))
    maneuvers.push_back(std::move(each));
  return maneuvers;
}

}  // namespace mocha
