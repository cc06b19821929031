#include "planning/global/front_end.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "planning/candidates/path_clearance.h"
#include "planning/candidates/peer_discs.h"
#include "planning/global/given_path.h"
#include "planning/global/parking_out.h"
#include "safety/requirement.h"
#include "trajectory/stopping.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

constexpr double kSameGoal_m = 0.5;
constexpr double kReachableStep_m = 0.1;  // between the places that are tried
// To what a drive costs, the costs of paths are in proportion to within a few percent, measured on
// maps of 100 m.
constexpr double kProportion = 0.93;

/// The shortest time in which a length can be driven from `speed` to rest, straight.
double least_duration_s(double length_m, double speed, const MotionLimits& limits) {
  const double a = limits.max_acceleration;
  const double v = std::min(limits.max_speed, std::sqrt(a * length_m + 0.5 * speed * speed));
  if (v <= speed) return length_m / std::max(speed, limits.max_speed);
  const double ramps_m = (2.0 * v * v - speed * speed) / (2.0 * a);
  return (2.0 * v - speed) / a + std::max(0.0, length_m - ramps_m) / v;
}

bool is_under_way(const PlanQuery& query, const Vector2& goal) {
  return !query.driven.empty() && query.driven.end_time() > query.start_time_s &&
         (query.driven.end_pose().position - goal).norm() < kSameGoal_m;
}

}  // namespace

HomotopyPathOptions homotopy_path_options(const RobotModel& robot, const PlannerOptions& options) {
  const double required_m = path_clearance_m(robot);
  const double max_speed = robot.limits.max_speed;
  const SpeedMargin margin = MarginBudget::of(robot).static_margin();
  const TravelOptions travel{required_m,
                             required_m + options.preferred_clearance_m,
                             options.clearance_weight,
                             Requirements(robot)[RequirementName::kPlan].leaving.way_m,
                             margin.at(max_speed) - margin.still_m,
                             std::min(1.0, kCreep_mps / max_speed)};
  return {travel, options.roadmap, options.classes, options.longest_ratio, options.prm_samples};
}

std::vector<Vector2> path_of(const Motion& motion, double from_s, double max_speed) {
  const double step_s = 0.2 / max_speed;
  std::vector<Vector2> points = {motion.position(from_s)};
  double start_s = motion.start_time();
  for (const Phase& phase : motion.phases()) {
    if (const auto* drive = std::get_if<DrivePhase>(&phase)) {
      const double end_s = drive->path.duration();
      for (double t = std::max(0.0, from_s - start_s) + step_s; t < end_s; t += step_s)
        points.push_back(drive->path.position(t));
    }
    start_s += duration_s(phase);
  }
  points.push_back(motion.end_pose().position);
  return points;
}

namespace {

HomotopyPaths only(std::vector<Vector2> path) {
  HomotopyPaths paths;
  paths.outcome = GridPath::Outcome::kFound;
  const double least_m = (path.back() - path.front()).norm();
  paths.paths.push_back({std::move(path), least_m, least_m, {}});
  return paths;
}

}  // namespace

FrontEnd::FrontEnd(const RobotModel& robot, const PlannerOptions& options)
    : robot_(robot),
      options_(homotopy_path_options(robot, options)),
      start_maneuvers_(robot.limits, options.smooth_start_rad),
      weight_duration_(options.weight_duration),
      below_driven_((1.0 - options.switch_margin) / (kShortened * kProportion)) {}

std::vector<BlockedDisc> FrontEnd::standing_peers(const PlanningScene& scene, double t) const {
  std::vector<BlockedDisc> discs;
  for (const auto& peer : scene.peers) {
    if (stands(*peer, t)) discs.push_back(peer_keep_out(*peer, t, robot_, kPathSlack_m));
  }
  return discs;
}

HomotopyPaths FrontEnd::paths(std::vector<Vector2> lead_in, const PlanQuery& query,
                              const PlanningScene& scene, const Vector2& goal,
                              std::optional<double> below_driven) const {
  if (!query.along.empty()) return only(given_path(query, lead_in.back(), robot_.limits.max_speed));
  HomotopyPathQuery paths;
  paths.below_driven = below_driven;
  paths.lead_in = std::move(lead_in);
  paths.goal = goal;
  paths.should_stop = query.should_stop;
  // A team-mate on the goal will hardly stay.
  for (const BlockedDisc& disc : standing_peers(scene, query.start_time_s)) {
    if ((disc.centre - goal).norm() > disc.radius_m) paths.blocked.push_back(disc);
  }
  if (is_under_way(query, goal)) {
    paths.driven = path_of(query.driven, query.start_time_s, robot_.limits.max_speed);
    paths.driven.front() = paths.lead_in.front();
    paths.driven.back() = goal;
  }
  return find_homotopy_paths(*scene.static_map, paths, options_);
}

Seed FrontEnd::seed_of(const HomotopyPath& path, std::vector<StartManeuver> start_maneuvers,
                       const std::optional<Signature>& driven) const {
  double least_s = std::numeric_limits<double>::infinity();
  for (const StartManeuver& start : start_maneuvers) {
    const double speed = start.state.col(1).norm();
    least_s = std::min(
        least_s, start.duration_s + least_duration_s(path.least_length_m, speed, robot_.limits));
  }
  Seed seed{std::move(start_maneuvers),
            {},
            path.signature,
            weight_duration_ * least_s,
            path.signature == driven};
  if (path.narrowest_on_lattice)
    seed.fallback = Fallback{FallbackKind::kLatticePath, *path.narrowest_on_lattice};
  return seed;
}

Drives FrontEnd::drives_of(const PlanQuery& query) const {
  return !query.along.empty() && robot_.may_back() ? Drives::kEitherWay : Drives::kForward;
}

GlobalSeeds FrontEnd::under_way(const MotionState& start, HomotopyPaths found,
                                Drives drives) const {
  GlobalSeeds result{{}, std::move(found.cuts), std::move(found.driven)};
  for (const HomotopyPath& path : found.paths) {
    std::vector<StartManeuver> start_maneuvers =
        start.at_rest ? start_maneuvers_.from_rest({}, start.pose, path.points, drives)
                      : start_maneuvers_.rolling(start, path.points, drives);
    if (start_maneuvers.empty()) continue;
    result.list.push_back(seed_of(path, std::move(start_maneuvers), result.driven));
  }
  return result;
}

GlobalSeeds FrontEnd::promising(const PlanQuery& query, const PlanningScene& scene,
                                const Vector2& goal) const {
  // What moves makes a drive dearer than its path tells.
  const bool all_stand = std::all_of(scene.peers.begin(), scene.peers.end(), [&](const auto& peer) {
    return stands(*peer, query.start_time_s);
  });
  if (!is_under_way(query, goal) || !all_stand) return {};
  const MotionState start = query.committed.at(query.start_time_s);
  GlobalSeeds found = under_way(
      start, paths({start.pose.position}, query, scene, goal, below_driven_), drives_of(query));
  const bool has_driven = std::any_of(found.list.begin(), found.list.end(),
                                      [](const Seed& seed) { return seed.driven; });
  return has_driven ? found : GlobalSeeds();
}

GlobalSeeds FrontEnd::seeds(const PlanQuery& query, const PlanningScene& scene,
                            const Vector2& goal) const {
  const MotionState start = query.committed.at(query.start_time_s);
  if (turns_back_first(query, start)) {
    const double rests_s = query.committed.end_time();
    return after(query.committed.phases_between(query.start_time_s, rests_s), query, scene, goal);
  }
  HomotopyPaths found = paths({start.pose.position}, query, scene, goal);
  const std::size_t count = found.paths.size();
  GlobalSeeds result = under_way(start, std::move(found), drives_of(query));
  if (result.list.size() == count) return result;
  for (Seed& seed : after_braking(query, scene, goal).list) {
    if (!has_class(result.list, seed.signature)) result.list.push_back(std::move(seed));
  }
  return result;
}

GlobalSeeds FrontEnd::after_braking(const PlanQuery& query, const PlanningScene& scene,
                                    const Vector2& goal) const {
  if (query.committed.at(query.start_time_s).at_rest) return {};
  return after(
      brake_along(query.committed, query.start_time_s, Braking(rest_acceleration(robot_.limits))),
      query, scene, goal);
}

GlobalSeeds FrontEnd::after_parking_out(const PlanQuery& query, const PlanningScene& scene,
                                        const Vector2& goal) const {
  const MotionState start = query.committed.at(query.start_time_s);
  if (!start.at_rest) return {};
  const std::vector<Phase> way_out =
      park_out(start.pose, robot_, scene, standing_peers(scene, query.start_time_s));
  if (way_out.empty()) return {};
  return after(way_out, query, scene, goal);
}

GlobalSeeds FrontEnd::after(const std::vector<Phase>& before, const PlanQuery& query,
                            const PlanningScene& scene, const Vector2& goal) const {
  const Motion lead_in(query.start_time_s, before);
  HomotopyPaths found =
      paths(path_of(lead_in, query.start_time_s, robot_.limits.max_speed), query, scene, goal);
  GlobalSeeds result{{}, std::move(found.cuts), std::move(found.driven)};
  for (const HomotopyPath& path : found.paths) {
    result.list.push_back(seed_of(
        path, start_maneuvers_.from_rest(before, lead_in.end_pose(), path.points, drives_of(query)),
        result.driven));
  }
  return result;
}

bool FrontEnd::may_reach(const Vector2& start, const Vector2& goal,
                         const StaticMap& static_map) const {
  // From where there is room, all paths keep it. From elsewhere, no motion has less room than this,
  // not even one that leaves a tight place: see parking_out.
  const double tight_m = robot_.footprint.inscribed_radius_m() -
                         Requirements(robot_)[RequirementName::kPlan].leaving.deepest_m;
  const bool has_room = static_map.field().distance_bound(start) >= required_clearance_m();
  const double least_m =
      has_room ? required_clearance_m() : std::min(required_clearance_m(), tight_m);
  // From closer, paths may be as close as the start.
  if (static_map.field().distance_bound(start) < least_m) return true;
  const double half_diagonal_m = M_SQRT2 * static_map.detail_m();
  const auto space = static_map.connectivity(std::max(0.0, least_m - half_diagonal_m));
  return !space || space->connects(start, goal);
}

bool FrontEnd::reaches(const Vector2& start, const Vector2& goal, const StaticMap& static_map,
                       const std::function<bool()>& should_stop) const {
  const TravelCost cost(static_map, start, {}, options_.travel);
  return find_grid_path(static_map, start, goal, cost, kLatticeStep_m, should_stop).outcome ==
         GridPath::Outcome::kFound;
}

std::optional<NarrowPlace> FrontEnd::narrowest(const Vector2& start, const Vector2& goal,
                                               const StaticMap& static_map,
                                               const std::function<bool()>& should_stop) const {
  const double needed_m = passable_gap_m(robot_);
  // What is not even a cell wide is no way.
  const auto space = static_map.connectivity(0.5 * static_map.detail_m());
  if (space && space->holds(start) && !space->connects(start, goal)) return std::nullopt;
  for (const double free_radius_m : {options_.travel.escape_radius_m, 0.0}) {
    const auto narrow =
        narrowest_place(static_map, start, goal, kLatticeStep_m, free_radius_m, should_stop);
    if (narrow && narrow->width_m < needed_m) return narrow;
  }
  return std::nullopt;
}

Vector2 FrontEnd::nearest_reachable(const Vector2& start, const Vector2& goal,
                                    const StaticMap& static_map,
                                    const std::function<bool()>& should_stop) const {
  const auto space = static_map.connectivity(required_clearance_m());
  if (space && space->holds(start)) return space->nearest(start, goal).value_or(start);
  const TravelCost cost(static_map, start, {}, options_.travel);
  Vector2 nearest = start;
  find_nearest_place(static_map, start, cost, kReachableStep_m, TravelCost::kInfinity,
                     [&](const Vector2& place) {
                       if ((place - goal).norm() < (nearest - goal).norm()) nearest = place;
                       return should_stop();
                     });
  return nearest;
}

}  // namespace mocha
