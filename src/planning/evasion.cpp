#include "planning/evasion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planning/conflict.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kDistances_m[] = {0.4, 0.8, 1.3, 2.0};
constexpr int kDirections = 24;
constexpr std::size_t kMost = 10;
// Enough room is enough; of those that have it, the one that is soonest done is the best.
constexpr double kEnough_m = 0.05;
constexpr double kNoTurn_rad = 0.005;
constexpr double kShareOfLimits = 0.95;

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

/// Turns by the smaller angle, so that either the front or the back points to the place.
std::vector<Phase> step_to(const Pose& from, const Vector2& place, const MotionLimits& limits) {
  const Vector2 way = place - from.position;
  const double ahead = wrap_angle(std::atan2(way.y(), way.x()) - from.yaw_rad);
  const double direction = std::abs(ahead) <= 0.5 * M_PI ? 1.0 : -1.0;
  const double change = direction > 0.0 ? ahead : wrap_angle(ahead + M_PI);
  Pose faced = from;
  std::vector<Phase> phases;
  if (std::abs(change) > kNoTurn_rad) {
    phases.emplace_back(TurnPhase{
        from, change, turn_duration_s(change, limits.max_yaw_rate, limits.max_yaw_acceleration)});
    faced.yaw_rad = wrap_angle(from.yaw_rad + change);
  }
  phases.emplace_back(straight(faced, direction, way.norm(), limits));
  return phases;
}

bool stands_free(const Vector2& from, const Vector2& to, const EvasionScene& scene) {
  for (double share = 0.25; share <= 1.0; share += 0.25) {
    if (scene.obstacles.distance_bound(from + share * (to - from)) < scene.required_clearance_m)
      return false;
  }
  return true;
}

/// What may come near a place of an evasion, or of the braking before it, in time.
std::vector<MovingThing> within_reach(const EvasionScene& scene, const Vector2& stop,
                                      double brake_m, double from_s) {
  const double reach_m =
      *std::max_element(std::begin(kDistances_m), std::end(kDistances_m)) + kEnough_m + brake_m;
  std::vector<MovingThing> near;
  for (const MovingThing& thing : scene.moving) {
    const MovingObstacle::Disc disc = thing.obstacle->at(from_s);
    const double comes_m =
        thing.obstacle->max_closing_speed(from_s) * std::max(0.0, scene.until_s - from_s);
    if ((disc.centre - stop).norm() <= disc.radius_m + thing.keep_m + reach_m + comes_m)
      near.push_back(thing);
  }
  return near;
}

}  // namespace

std::vector<Motion> evasions(const Motion& committed, double start_time_s, double deceleration,
                             const RobotModel& robot, const EvasionScene& scene) {
  const std::vector<Phase> brake = brake_along(committed, start_time_s, deceleration);
  const Pose stop = Motion(start_time_s, brake).end_pose();
  const std::vector<MovingThing> near =
      within_reach(scene, stop.position, (committed.position(start_time_s) - stop.position).norm(),
                   start_time_s);
  struct Choice {
    double room_m;
    Motion motion;
  };
  std::vector<Choice> choices;
  for (const double distance_m : kDistances_m) {
    for (int i = 0; i < kDirections; ++i) {
      const double angle = stop.yaw_rad + 2.0 * M_PI * i / kDirections;
      const Vector2 place = stop.position + distance_m * Vector2(std::cos(angle), std::sin(angle));
      if (!stands_free(stop.position, place, scene)) continue;
      std::vector<Phase> phases = brake;
      for (const Phase& phase : step_to(stop, place, robot.limits)) phases.push_back(phase);
      Motion motion(start_time_s, std::move(phases));
      const double room_m = least_room_m(motion, near, start_time_s, scene.until_s);
      choices.push_back({room_m, std::move(motion)});
    }
  }
  std::stable_sort(choices.begin(), choices.end(), [](const Choice& a, const Choice& b) {
    const double room_a = std::min(a.room_m, kEnough_m);
    const double room_b = std::min(b.room_m, kEnough_m);
    return room_a != room_b ? room_a > room_b : a.motion.end_time() < b.motion.end_time();
  });
  std::vector<Motion> motions;
  for (Choice& choice : choices) {
    if (motions.size() < kMost) motions.push_back(std::move(choice.motion));
  }
  return motions;
}

}  // namespace mocha
