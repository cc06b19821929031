#include "topology/paths/homotopy_paths.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <utility>

#ifdef MOCHA_WITH_CGAL
#include "topology/roadmaps/apollonius_roadmap.h"
#endif
#include "topology/paths/class_search.h"
#include "topology/paths/path_shortcutting.h"
#include "topology/roadmaps/roadmap_simplification.h"
#include "topology/roadmaps/static_space.h"
#include "topology/roadmaps/visibility_prm.h"
#include "topology/signatures/length_bound.h"

namespace mocha {
namespace {

constexpr int kSpare = 2;                // paths that are shortened, for each one that is kept
constexpr double kCircleError_m = 0.12;  // of the circles that stand for solid matter, at most
constexpr double kNarrowest = 0.5;  // passage that obstacles are told apart by, of the required
constexpr std::uint64_t kSeed = 1;  // of the sampled roadmap
constexpr double kReach_m = 20.0;   // its edges are no longer

/// Obstacles and their cuts as seen by one robot.
struct Scenery {
  std::vector<ObstacleGroup> groups;
  Cuts<2> cuts;
};

/// A path that begins inside may leave.
double radius_of(const BlockedDisc& disc, const TravelCost& cost) {
  return std::min(disc.radius_m, (cost.start() - disc.centre).norm());
}

Scenery scenery_of(const TravelCost& cost) {
  const double required_m = cost.options().required_clearance_m;
  // What one starts between can be passed, though it be too narrow elsewhere.
  const double start_m = cost.static_map().field().sample(cost.start()).distance_m;
  std::vector<ObstacleGroup> groups =
      cost.static_map().groups(std::clamp(start_m, kNarrowest * required_m, required_m));
  for (const BlockedDisc& disc : cost.blocked()) {
    const double radius_m = radius_of(disc, cost) - required_m;
    groups.push_back({disc.centre, {{disc.centre, std::max(0.0, radius_m)}}});
  }
  std::vector<Vector2> representatives;
  for (const ObstacleGroup& group : groups) representatives.push_back(group.representative);
  return {std::move(groups), Cuts<2>(representatives)};
}

/// The static map and the discs.
class TravelSpace : public StaticSpace<2> {
 public:
  TravelSpace(const TravelCost& cost, const Cuts<2>& cuts)
      : StaticSpace<2>(cost.static_map().field(), cuts, cost.static_map().bounds(), cost.start(),
                       {cost.options().required_clearance_m, cost.options().escape_radius_m}),
        cost_(cost) {}

  using StaticSpace<2>::clearance_m;
  std::optional<double> clearance_m(const Vector2& p, const Vector2& q) const override {
    for (const BlockedDisc& disc : cost_.blocked()) {
      const double apart_m = (nearest_on_segment(disc.centre, p, q) - disc.centre).norm();
      if (apart_m < radius_of(disc, cost_)) return std::nullopt;
    }
    return StaticSpace<2>::clearance_m(p, q);
  }

 private:
  const TravelCost& cost_;
};

Roadmap<2> roadmap_of(const TravelCost& cost, const Scenery& scenery, const Vector2& goal,
                      const HomotopyPathOptions& options) {
#ifdef MOCHA_WITH_CGAL
  if (options.roadmap == RoadmapKind::kApollonius) {
    const double required_m = options.travel.required_clearance_m;
    const double relaxed_m = std::max(kNarrowest * required_m, required_m - kCircleError_m);
    return apollonius_roadmap(scenery.groups, cost.static_map().bounds(), cost.start(), goal,
                              {relaxed_m, options.travel.escape_radius_m});
  }
#endif
  return visibility_prm<2>(TravelSpace(cost, scenery.cuts), cost.start(), goal,
                           {options.prm_samples, kSeed, kReach_m});
}

/// From the start that `cost` knows.
std::vector<std::vector<Vector2>> paths_of_classes(const TravelCost& cost, const Scenery& scenery,
                                                   const Vector2& goal,
                                                   const HomotopyPathOptions& options) {
  Roadmap<2> roadmap = roadmap_of(cost, scenery, goal, options);
  price(roadmap, cost);
  roadmap = contracted(roadmap);
  add_shortcuts(roadmap, cost);
  std::vector<std::vector<Vector2>> paths;
  for (auto& path :
       shortest_classes(roadmap, scenery.cuts, {kSpare * options.classes, options.longest_ratio}))
    paths.push_back(std::move(path.points));
  if (!paths.empty()) return paths;
  // Too narrow for the roadmap's circles, perhaps; the lattice is slower, but misses nothing.
  GridPath path = find_grid_path(cost.static_map(), cost.start(), goal, cost, kLatticeStep_m);
  if (path.outcome == GridPath::Outcome::kFound) paths.push_back(std::move(path.points));
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
std::vector<HomotopyPath> paths_along(const std::vector<std::vector<Vector2>>& paths,
                                      const TravelCost& cost, const Cuts<2>& cuts,
                                      const std::vector<Vector2>& lead_in) {
  const Signature before = signature_of<2>(cuts, lead_in);
  std::vector<HomotopyPath> found(paths.size());
  tbb::parallel_for(std::size_t{0}, paths.size(), [&](std::size_t i) {
    HomotopyPath& found_path = found[i];
    found_path.points = with_shortcuts(paths[i], cost, cuts);
    found_path.cost_m = cost_of(found_path.points, cost);
    found_path.signature = signature_of<2>(cuts, found_path.points);
    std::transform(before.begin(), before.end(), found_path.signature.begin(),
                   found_path.signature.begin(), std::plus<int>());
    found_path.least_length_m = least_length_m(found_path.points, cost.static_map().field());
  });
  return found;
}

/// Of each class the cheapest, cheapest first; what is driven stays in any case.
void keep_best(std::vector<HomotopyPath>& found, const std::optional<Signature>& driven,
               const HomotopyPathOptions& options) {
  std::stable_sort(found.begin(), found.end(), [](const HomotopyPath& a, const HomotopyPath& b) {
    return a.cost_m < b.cost_m;
  });
  std::vector<HomotopyPath> kept;
  for (HomotopyPath& found_path : found) {
    const auto twin = std::find_if(kept.begin(), kept.end(), [&](const HomotopyPath& other) {
      return other.signature == found_path.signature;
    });
    if (twin != kept.end()) continue;
    const bool good = static_cast<int>(kept.size()) < options.classes &&
                      found_path.cost_m <= options.longest_ratio * found.front().cost_m;
    if (good || found_path.signature == driven) kept.push_back(std::move(found_path));
  }
  found = std::move(kept);
}

}  // namespace

RoadmapKind roadmap_kind(const std::string& name) {
#ifdef MOCHA_WITH_CGAL
  constexpr bool kHaveApollonius = true;
#else
  constexpr bool kHaveApollonius = false;
#endif
  if (name == "visibility_prm") return RoadmapKind::kVisibilityPrm;
  if (name == "best")
    return kHaveApollonius ? RoadmapKind::kApollonius : RoadmapKind::kVisibilityPrm;
  if (name != "apollonius") {
    throw std::invalid_argument("roadmap = " + name + ", one of best, apollonius, visibility_prm");
  }
  if (!kHaveApollonius) throw std::invalid_argument("roadmap = apollonius: built without CGAL");
  return RoadmapKind::kApollonius;
}

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
  const Scenery scenery = scenery_of(cost);
  std::vector<std::vector<Vector2>> paths = paths_of_classes(cost, scenery, query.goal, options);
  const std::vector<Vector2> driven = still_drivable(query.driven, cost);
  if (query.lead_in.size() == 1 && !driven.empty()) paths.push_back(driven);
  result.paths = paths_along(paths, cost, scenery.cuts, query.lead_in);
  if (!query.driven.empty()) result.driven = signature_of<2>(scenery.cuts, query.driven);
  keep_best(result.paths, result.driven, options);
  result.cuts = scenery.cuts;
  result.outcome = result.paths.empty() ? GridPath::Outcome::kNoPath : GridPath::Outcome::kFound;
  return result;
}

}  // namespace mocha
