#include "topology/paths/homotopy_paths.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "topology/paths/class_search.h"
#include "topology/paths/path_shortcutting.h"
#include "topology/roadmaps/roadmap_simplification.h"
#include "topology/signatures/length_bound.h"

namespace mocha {
namespace {

constexpr int kSpare = 2;  // paths that are shortened, for each one that is kept

HomotopyPath through(std::vector<Vector2> points) {
  HomotopyPath path;
  path.points = std::move(points);
  return path;
}

/// The point with the least room.
Vector2 narrowest(const std::vector<Vector2>& points, const ObstacleField<2>& field) {
  return *std::min_element(points.begin(), points.end(), [&](const Vector2& a, const Vector2& b) {
    return field.distance_bound(a) < field.distance_bound(b);
  });
}

/// From the start that `cost` knows, no dearer than `most_m`; only their points.
std::vector<HomotopyPath> paths_of_classes(const TravelCost& cost, const ClassRoadmap& classes,
                                           const HomotopyPathQuery& query,
                                           const HomotopyPathOptions& options, double most_m) {
  std::vector<HomotopyPath> paths;
  for (auto& path :
       shortest_classes(classes.roadmap, classes.cuts,
                        {kSpare * options.classes, options.longest_ratio / kShortened, most_m}))
    paths.push_back(through(std::move(path.points)));
  if (!paths.empty() || query.below_driven) return paths;
  // Too narrow for the roadmap's circles, perhaps; the lattice is slower, but misses nothing.
  GridPath path = find_grid_path(cost.static_map(), cost.start(), query.goal, cost, kLatticeStep_m,
                                 query.should_stop);
  if (path.outcome != GridPath::Outcome::kFound) return paths;
  const Vector2 tight = narrowest(path.points, cost.static_map().field());
  paths.push_back(through(std::move(path.points)));
  paths.back().narrowest_on_lattice = tight;
  return paths;
}

/// The path that is driven, moved off what has come to light beside it since; empty where it is
/// blocked.
std::vector<Vector2> still_drivable(std::vector<Vector2> path, const TravelCost& cost) {
  for (std::size_t i = 1; i + 1 < path.size(); ++i) path[i] = pushed_off(path[i], cost);
  const bool possible = path.size() >= 2 && std::isfinite(cost_of(path, cost));
  return possible ? path : std::vector<Vector2>{};
}

/// Makes each path as cheap as its class allows.
void shorten(std::vector<HomotopyPath>& paths, const TravelCost& cost, const Cuts<2>& cuts,
             const HomotopyPathQuery& query) {
  const Signature before = signature_of<2>(cuts, query.lead_in);
  tbb::parallel_for(std::size_t{0}, paths.size(), [&](std::size_t i) {
    if (query.should_stop()) return;
    HomotopyPath& found_path = paths[i];
    found_path.points = with_shortcuts(found_path.points, cost, cuts);
    found_path.cost_m = cost_of(found_path.points, cost);
    found_path.signature = signature_of<2>(cuts, found_path.points);
    std::transform(before.begin(), before.end(), found_path.signature.begin(),
                   found_path.signature.begin(), std::plus<int>());
    found_path.least_length_m = least_length_m(found_path.points, cost.static_map().field());
  });
}

/// Of each class the cheapest, cheapest first; what is driven stays in any case.
void keep_best(std::vector<HomotopyPath>& found, const std::optional<Signature>& driven,
               const HomotopyPathOptions& options) {
  std::stable_sort(found.begin(), found.end(), [](const HomotopyPath& a, const HomotopyPath& b) {
    return a.cost_m < b.cost_m;
  });
  std::vector<HomotopyPath> kept;
  for (HomotopyPath& found_path : found) {
    if (has_class(kept, found_path.signature)) continue;
    const bool good = static_cast<int>(kept.size()) < options.classes &&
                      found_path.cost_m <= options.longest_ratio * found.front().cost_m;
    if (good || found_path.signature == driven) kept.push_back(std::move(found_path));
  }
  found = std::move(kept);
}

}  // namespace

HomotopyPaths find_homotopy_paths(const StaticMap& static_map, const HomotopyPathQuery& query,
                                  const HomotopyPathOptions& options) {
  const Vector2& start = query.start();
  const TravelCost cost(static_map, start, query.blocked, options.travel);
  HomotopyPaths result;
  result.outcome = GridPath::Outcome::kStartBlocked;
  if (!static_map.bounds().contains(start) || cost.at(start) == TravelCost::kInfinity)
    return result;
  result.outcome = GridPath::Outcome::kGoalBlocked;
  if (!static_map.bounds().contains(query.goal) || cost.at(query.goal) == TravelCost::kInfinity)
    return result;
  const std::vector<Vector2> driven = still_drivable(query.driven, cost);
  result.outcome = GridPath::Outcome::kNoPath;
  if (query.below_driven && driven.empty()) return result;
  const double most_m =
      query.below_driven ? *query.below_driven * cost_of(driven, cost) : TravelCost::kInfinity;
  result.outcome = GridPath::Outcome::kStopped;
  ClassRoadmap classes =
      class_roadmap(cost, query.goal, options.roadmap, options.prm_samples, query.should_stop);
  if (query.should_stop()) return result;
  std::vector<HomotopyPath> found = paths_of_classes(cost, classes, query, options, most_m);
  if (query.lead_in.size() == 1 && !driven.empty()) found.push_back(through(driven));
  shorten(found, cost, classes.cuts, query);
  if (query.should_stop()) return result;
  result.paths = std::move(found);
  if (!query.driven.empty()) result.driven = signature_of<2>(classes.cuts, query.driven);
  keep_best(result.paths, result.driven, options);
  result.cuts = std::move(classes.cuts);
  result.outcome = result.paths.empty() ? GridPath::Outcome::kNoPath : GridPath::Outcome::kFound;
  return result;
}

}  // namespace mocha
