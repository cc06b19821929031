#include "topology/space_time/space_time_paths.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "topology/paths/class_search.h"
#include "topology/paths/euclidean_shortcutting.h"
#include "topology/roadmaps/visibility_prm.h"
#include "topology/space_time/space_time.h"

namespace mocha {
namespace {

using Point = Eigen::Vector3d;

constexpr int kSpare = 2;           // paths that are shortened, for each one that is kept
constexpr double kFinest_m = 1e-3;  // such a passage, at least

/// Without a look at how exactly it moves.
bool out_of_reach(const MovingThing& thing, const SpaceTimeQuery& query, double max_speed) {
  const double now_s = query.start.time_s;
  const MovingObstacle::Disc disc = thing.obstacle->at(now_s);
  const double closing = max_speed + thing.obstacle->max_closing_speed(now_s);
  const double gap_m = (disc.centre - query.start.position).norm() - disc.radius_m - thing.keep_m;
  return gap_m > closing * (query.goal.time_s - now_s);
}

std::vector<Tube<2>> tubes_of(const SpaceTimeQuery& query, double max_speed) {
  std::vector<Tube<2>> tubes(query.moving.size());
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    const MovingThing& thing = query.moving[i];
    if (out_of_reach(thing, query, max_speed)) continue;
    const double goal_s = query.goal.time_s;
    const double until_s = thing.until_s < goal_s ? thing.until_s : goal_s;
    tubes[i] = tube_of(*thing.obstacle, query.start.time_s, until_s, thing.keep_m);
  }
  return tubes;
}

/// What is being driven, led from the start and on to the goal past those of its points from which
/// that is possible.
std::vector<Point> driven_path(const SpaceTime<2>& space, const TimedPath& driven) {
  std::vector<Point> path = {space.start()};
  for (const TimedPoint& each : driven) {
    const Point p = space.point(each.position, each.time_s);
    if (space.in_order(path.back(), p) && space.in_order(p, space.goal())) path.push_back(p);
  }
  path.push_back(space.goal());
  return path;
}

bool is_clear(const std::vector<Point>& path, const SpaceTime<2>& space) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (!space.clearance_m(path[i - 1], path[i])) return false;
  }
  return true;
}

SpaceTimePath path_along(const std::vector<Point>& path, const SpaceTime<2>& space,
                         const SpaceTimeQuery& query) {
  SpaceTimePath found_path{{}, 0.0, space.signature_of(path), false};
  double action = 0.0;  // integral of the squared speed, in metres as all of space-time
  for (std::size_t i = 0; i < path.size(); ++i) {
    found_path.points.push_back({path[i].head<2>(), space.time_s(path[i])});
    if (i == 0) continue;
    const Point step = path[i] - path[i - 1];
    action += step.head<2>().squaredNorm() / step.z();
  }
  found_path.points.front() = query.start;
  found_path.points.back() = query.goal;
  found_path.length_m = std::sqrt(action * (path.back() - path.front()).z());
  return found_path;
}

/// Of each class the shortest, shortest first; what is driven stays in any case.
void keep_best(std::vector<SpaceTimePath>& found, const SpaceTimeOptions& options) {
  std::stable_sort(found.begin(), found.end(), [](const SpaceTimePath& a, const SpaceTimePath& b) {
    return a.length_m < b.length_m;
  });
  std::vector<SpaceTimePath> kept;
  for (SpaceTimePath& found_path : found) {
    if (has_class(kept, found_path.signature)) continue;
    const bool good = static_cast<int>(kept.size()) < options.classes &&
                      found_path.length_m <= options.longest_ratio * found.front().length_m;
    if (good || found_path.driven) kept.push_back(std::move(found_path));
  }
  found = std::move(kept);
}

std::vector<SpaceTimePath> paths_through(const SpaceTime<2>& space, const SpaceTimeQuery& query,
                                         const SpaceTimeOptions& options) {
  const Roadmap<3> roadmap =
      visibility_prm<3>(space, space.start(), space.goal(),
                        {options.samples, options.seed, M_SQRT2 * space.goal().z()});
  std::vector<std::vector<Point>> paths;
  for (auto& path : shortest_classes<3>(roadmap, space, {kSpare * options.classes, M_SQRT2}))
    paths.push_back(std::move(path.points));
  const std::vector<Point> driven = driven_path(space, query.driven);
  const bool drives = driven.size() > 2;
  if (drives && is_clear(driven, space)) paths.push_back(driven);
  std::vector<SpaceTimePath> found;
  for (auto& path : paths)
    found.push_back(path_along(with_shortcuts<3>(std::move(path), space), space, query));
  if (drives) {
    const Signature signature = space.signature_of(driven);
    for (SpaceTimePath& found_path : found) found_path.driven = found_path.signature == signature;
  }
  keep_best(found, options);
  return found;
}

void check(const SpaceTimeOptions& options) {
  const auto require = [](bool condition, const char* name, double value, const char* range) {
    if (condition) return;
    throw std::invalid_argument(std::string("SpaceTimeOptions: ") + name + " = " +
                                std::to_string(value) + ": expected " + range);
  };
  require(options.max_speed > 0.0 && std::isfinite(options.max_speed), "max_speed",
          options.max_speed, "a finite value above 0");
  require(options.classes >= 1, "classes", options.classes, "at least 1");
  require(options.longest_ratio >= 1.0, "longest_ratio", options.longest_ratio, "at least 1");
}

/// Whether something is there at the goal's time; found out before all that costs more.
bool is_taken(const TimedPoint& goal, const std::vector<Tube<2>>& tubes) {
  const auto holds_goal = [&goal](const TubePiece<2>& piece) {
    return least_gap_m<2>(piece, goal.position, goal.time_s, goal.position, goal.time_s) < 0.0;
  };
  return std::any_of(tubes.begin(), tubes.end(), [&](const Tube<2>& tube) {
    return std::any_of(tube.begin(), tube.end(), holds_goal);
  });
}

bool is_finite(const TimedPoint& p) { return p.position.allFinite() && std::isfinite(p.time_s); }

}  // namespace

Eigen::AlignedBox2d reach_of(const SpaceTimeQuery& query, double max_speed) {
  const double half_m = 0.5 * max_speed * (query.goal.time_s - query.start.time_s);
  const Vector2 middle = 0.5 * (query.start.position + query.goal.position);
  const Vector2 focus = 0.5 * (query.goal.position - query.start.position);
  const double across2 = std::max(0.0, half_m * half_m - focus.squaredNorm());  // of an ellipse
  const Vector2 half = (focus.cwiseAbs2() + Vector2::Constant(across2)).cwiseSqrt();
  return {middle - half, middle + half};
}

Cuts<2> cuts_within(const StaticMap& static_map, const Eigen::AlignedBox2d& reach,
                    const Vector2& start, const SpaceTimeOptions& options) {
  // What one starts between can be passed, though it be too narrow elsewhere.
  const double required_m = options.required_clearance_m;
  const double start_m = static_map.field().sample(start).distance_m;
  const double passage_m = std::clamp(start_m, kNarrowestPassage * required_m, required_m);
  std::vector<Vector2> representatives;
  for (const ObstacleGroup& group : static_map.groups_within(reach, std::max(kFinest_m, passage_m)))
    representatives.push_back(group.representative);
  return Cuts<2>(representatives);
}

SpaceTimePaths find_space_time_paths(const StaticMap& static_map, const SpaceTimeQuery& query,
                                     const SpaceTimeOptions& options) {
  check(options);
  if (!is_finite(query.start) || !is_finite(query.goal))
    return find_space_time_paths(static_map, Cuts<2>({}), query, options);
  const Cuts<2> cuts =
      cuts_within(static_map, reach_of(query, options.max_speed), query.start.position, options);
  return find_space_time_paths(static_map, cuts, query, options);
}

SpaceTimePaths find_space_time_paths(const StaticMap& static_map, const Cuts<2>& cuts,
                                     const SpaceTimeQuery& query, const SpaceTimeOptions& options) {
  using Outcome = SpaceTimePaths::Outcome;
  check(options);
  const TimedPoint& start = query.start;
  const TimedPoint& goal = query.goal;
  if (!is_finite(start)) return {Outcome::kStartBlocked, {}};
  if (!is_finite(goal)) return {Outcome::kGoalBlocked, {}};
  if (!(start.time_s < goal.time_s)) return {Outcome::kNoPath, {}};
  std::vector<Tube<2>> tubes = tubes_of(query, options.max_speed);
  if (is_taken(goal, tubes)) return {Outcome::kGoalBlocked, {}};
  const SpaceTime<2> space(static_map.field(), cuts, static_map.bounds(),
                           {start.position, goal.position, start.time_s, goal.time_s},
                           options.max_speed, std::move(tubes),
                           {options.required_clearance_m, options.escape_radius_m});
  if (!space.clearance_m(space.start())) return {Outcome::kStartBlocked, {}};
  if (!space.clearance_m(space.goal())) return {Outcome::kGoalBlocked, {}};
  if (!space.goal().allFinite() || !space.in_order(space.start(), space.goal()))
    return {Outcome::kNoPath, {}};
  std::vector<SpaceTimePath> found = paths_through(space, query, options);
  if (found.empty()) return {Outcome::kNoPath, {}};
  return {Outcome::kFound, std::move(found)};
}

}  // namespace mocha
