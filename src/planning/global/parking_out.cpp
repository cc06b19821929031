#include "planning/global/parking_out.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

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
constexpr double kFarthestExit_m = 30.0;
constexpr double kDriveRounding_m = 0.005;  // so much closer than searched, a drive may be
constexpr double kSlow_mps = 0.3;
// Where there is the least room, so slow is the robot that it asks for so much more at most.
constexpr double kSlowest_mps = 0.1;
constexpr double kForSpeed_m = 0.002;
constexpr double kShareOfSpeed = 0.8;  // for what drives overshoot between their knots
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
  /// How fast a pose lets the robot be.
  using SpeedAtPose = std::function<double(const Pose&)>;

  PhaseMaker(const Pose& start, const MotionLimits& limits, SpeedAtPose fastest_at)
      : pose_(start), limits_(limits), slow_(limits), fastest_at_(std::move(fastest_at)) {
    slow_.max_speed = std::min(slow_.max_speed, kSlow_mps);
    slow_.max_acceleration *= 0.5;
  }

  std::optional<Phase> make(std::vector<Stretch>::const_iterator first,
                            std::vector<Stretch>::const_iterator last) {
    const Pose start = pose_;
    std::vector<Vector2> path = {start.position};
    std::vector<double> fastest = {fastest_at_(start)};
    for (auto stretch = first; stretch != last; ++stretch) {
      const int parts = std::ceil(std::abs(stretch->length_m) / kPointSpacing_m);
      for (int i = 1; i <= parts; ++i) {
        const Pose pose = along(pose_, *stretch, static_cast<double>(i) / parts);
        path.push_back(pose.position);
        fastest.push_back(fastest_at_(pose));
      }
      pose_ = along(pose_, *stretch, 1.0);
    }
    const int direction = direction_of(*first);
    if (direction == 0) return turn(start);
    const auto fastest_near = [&](const Vector2& place) {
      const auto nearest =
          std::min_element(path.begin(), path.end(), [&](const Vector2& a, const Vector2& b) {
            return (a - place).squaredNorm() < (b - place).squaredNorm();
          });
      return fastest[nearest - path.begin()];
    };
    const auto drive = drive_along(path,
                                   {direction, course(start, direction), course(pose_, direction),
                                    kKnotSpacing_m, slow_, fastest_near},
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
  SpeedAtPose fastest_at_;
};

std::vector<Phase> phases_of(const std::vector<Stretch>& way, const Pose& start,
                             const MotionLimits& limits,
                             const PhaseMaker::SpeedAtPose& fastest_at) {
  std::vector<Phase> phases;
  PhaseMaker maker(start, limits, fastest_at);
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

/// Keeps from all of the fields.
std::vector<Phase> park_out(const Pose& start, const RobotModel& robot, const StaticMap& static_map,
                            const std::vector<const ObstacleField<2>*>& fields,
                            const std::vector<BlockedDisc>& blocked) {
  const double reach_m = robot.footprint.cover_reach_m();
  const SpeedMargin margin = MarginBudget::of(robot).static_margin();
  const double slowest = std::min(kSlowest_mps, margin.fastest(margin.still_m + kForSpeed_m));
  const double margin_m = margin.at(slowest) + kDriveRounding_m;
  const Leaving leaving = Requirements(robot)[RequirementName::kPlan].leaving;
  // Wherever the body may fit: whether it does, is searched for.
  const double least_m = robot.footprint.inscribed_radius_m() - leaving.deepest_m;
  const TravelCost cost(static_map, start.position, blocked, {least_m, least_m, 0.0, 0.0});
  const auto can_turn = [&](const Vector2& place) {
    return cost.blocked_room_m(place) >= 0.0 &&
           std::all_of(fields.begin(), fields.end(), [&](const ObstacleField<2>* field) {
             return field->distance_bound(place) >= reach_m + margin_m;
           });
  };
  const GridPath to_exit = find_nearest_place(static_map, start.position, cost, kLatticeStep_m,
                                              kFarthestExit_m, can_turn);
  if (to_exit.outcome != GridPath::Outcome::kFound || can_turn(start.position)) return {};
  TightPlace tight;
  tight.start = start;
  tight.reach_m = reach_m;
  tight.margin_m = margin_m;
  tight.leaving = leaving;
  tight.can_reverse = robot.limits.can_reverse;
  tight.gap_m = [&](const Pose& pose) {
    if (cost.is_blocked(pose.position)) return -std::numeric_limits<double>::infinity();
    double gap_m = std::numeric_limits<double>::infinity();
    for (const ObstacleField<2>* field : fields)
      gap_m = std::min(gap_m, clearance_m(pose, robot.footprint, *field));
    return gap_m;
  };
  tight.is_out = [&](const Pose& pose) { return can_turn(pose.position); };
  tight.exit = to_exit.points.back();
  const auto fastest_at = [&](const Pose& pose) {
    return std::max(slowest, kShareOfSpeed * margin.fastest(tight.gap_m(pose) - kDriveRounding_m));
  };
  // Rather forward, where the lidar does not see what is behind.
  std::vector<Stretch> way;
  if (!robot.lidar.sees({-reach_m, 0.0})) {
    tight.can_reverse = false;
    way = find_way_out(tight, kMaxExpansions);
    tight.can_reverse = robot.limits.can_reverse;
  }
  if (way.empty()) way = find_way_out(tight, kMaxExpansions);
  return phases_of(way, start, robot.limits, fastest_at);
}

}  // namespace

std::vector<Phase> park_out(const Pose& start, const RobotModel& robot, const PlanningScene& scene,
                            const std::vector<BlockedDisc>& blocked) {
  const ObstacleField<2>& obstacles = scene.static_map->field();
  if (scene.unseen) {
    const auto unseen = scene.unseen();
    const auto way = park_out(start, robot, *scene.static_map, {&obstacles, unseen.get()}, blocked);
    if (!way.empty()) return way;
  }
  return park_out(start, robot, *scene.static_map, {&obstacles}, blocked);
}

}  // namespace mocha
