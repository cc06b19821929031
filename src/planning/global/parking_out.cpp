#include "planning/global/parking_out.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planning/candidates/path_drive.h"
#include "planning/candidates/start_maneuver.h"
#include "planning/global/tight_place.h"
#include "safety/certificate.h"
#include "safety/requirement.h"
#include "topology/paths/grid_path.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

constexpr int kMaxExpansions = 20000;
constexpr double kFarthestExit_m = 10.0;
constexpr double kRounding_m = 0.005;  // so much closer than searched, a drive may be
constexpr double kSlow_mps = 0.3;
constexpr double kPointSpacing_m = 0.01;
constexpr double kKnotSpacing_m = 0.04;

Vector2 course(const Pose& pose, int direction) {
  return direction * Vector2(std::cos(pose.yaw_rad), std::sin(pose.yaw_rad));
}

int direction_of(const Stretch& stretch) {
  return stretch.length_m == 0.0 ? 0 : std::copysign(1.0, stretch.length_m);
}

/// One phase for stretches of one kind, and where it ends.
class PhaseMaker {
 public:
  PhaseMaker(const Pose& start, const MotionLimits& limits)
      : pose_(start), limits_(limits), slow_(limits) {
    slow_.max_speed = std::min(slow_.max_speed, kSlow_mps);
    slow_.max_acceleration *= 0.5;
  }

  std::optional<Phase> make(std::vector<Stretch>::const_iterator first,
                            std::vector<Stretch>::const_iterator last) {
    const Pose start = pose_;
    std::vector<Vector2> path = {start.position};
    for (auto stretch = first; stretch != last; ++stretch) {
      const int parts = std::ceil(std::abs(stretch->length_m) / kPointSpacing_m);
      for (int i = 1; i <= parts; ++i)
        path.push_back(along(pose_, *stretch, static_cast<double>(i) / parts).position);
      pose_ = along(pose_, *stretch, 1.0);
    }
    const int direction = direction_of(*first);
    if (direction == 0) return turn(start);
    const auto drive = drive_along(
        path,
        {direction, course(start, direction), course(pose_, direction), kKnotSpacing_m, slow_},
        limits_);
    if (!drive) return std::nullopt;
    return Phase(*drive);
  }

 private:
  Phase turn(const Pose& start) const {
    const double change_rad = pose_.yaw_rad - start.yaw_rad;
    return TurnPhase{
        start, change_rad,
        turn_duration_s(change_rad, limits_.max_yaw_rate, limits_.max_yaw_acceleration)};
  }

  Pose pose_;
  const MotionLimits limits_;
  MotionLimits slow_;
};

std::vector<Phase> phases_of(const std::vector<Stretch>& way, const Pose& start,
                             const MotionLimits& limits) {
  std::vector<Phase> phases;
  PhaseMaker maker(start, limits);
  for (auto first = way.begin(); first != way.end();) {
    const auto last = std::find_if(first, way.end(), [&](const Stretch& stretch) {
      return direction_of(stretch) != direction_of(*first);
    });
    auto phase = maker.make(first, last);
    if (!phase) return {};
    phases.push_back(std::move(*phase));
    first = last;
  }
  return phases;
}

}  // namespace

std::vector<Phase> park_out(const Pose& start, const RobotModel& robot, const StaticMap& static_map,
                            const TravelOptions& travel) {
  const ObstacleField<2>& field = static_map.field();
  const double reach_m = robot.footprint.circumscribed_radius_m();
  const double margin_m = MarginBudget::of(robot).static_margin_m() + kRounding_m;
  const auto can_turn = [&](const Vector2& place) {
    return field.distance_bound(place) >= reach_m + margin_m;
  };
  const TravelCost cost(static_map, start.position, {}, travel);
  const GridPath to_exit = find_nearest_place(static_map, start.position, cost, kLatticeStep_m,
                                              kFarthestExit_m, can_turn);
  if (to_exit.outcome != GridPath::Outcome::kFound || can_turn(start.position)) return {};
  TightPlace tight;
  tight.start = start;
  tight.reach_m = reach_m;
  tight.margin_m = margin_m;
  tight.leaving = Requirements(robot)[RequirementName::kPlan].leaving;
  tight.can_reverse = robot.limits.can_reverse;
  tight.gap_m = [&](const Pose& pose) { return clearance_m(pose, robot.footprint, field); };
  tight.is_out = [&](const Pose& pose) { return can_turn(pose.position); };
  tight.exit = to_exit.points.back();
  return phases_of(find_way_out(tight, kMaxExpansions), start, robot.limits);
}

}  // namespace mocha
