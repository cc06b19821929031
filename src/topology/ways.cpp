#include "topology/ways.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#ifdef MOCHA_WITH_CGAL
#include "topology/apollonius_roadmap.h"
#endif
#include "topology/class_search.h"
#include "topology/length_bound.h"
#include "topology/path_shortening.h"
#include "topology/roadmap_tidying.h"
#include "topology/static_space.h"
#include "topology/visibility_prm.h"

namespace mocha {
namespace {

constexpr int kSpare = 2;                // ways that are shortened, for each one that is kept
constexpr double kCircleError_m = 0.12;  // of the circles that stand for solid matter, at most
constexpr double kNarrowest = 0.5;  // passage that obstacles are told apart by, of the required

/// Obstacles and their cuts as seen by one robot.
struct Scenery {
  std::vector<ObstacleGroup> groups;
  Cuts<2> cuts;
};

/// Who stands inside may leave.
double radius_of(const BlockedDisc& disc, const TravelCost& cost) {
  return std::min(disc.radius_m, (cost.start() - disc.centre).norm());
}

Scenery scenery_of(const TravelCost& cost) {
  const double required_m = cost.rules().required_clearance_m;
  // What one starts between can be passed, though it be too narrow elsewhere.
  const double start_m = cost.terrain().field().sample(cost.start()).distance_m;
  std::vector<ObstacleGroup> groups =
      cost.terrain().groups(std::clamp(start_m, kNarrowest * required_m, required_m));
  for (const BlockedDisc& disc : cost.blocked()) {
    const double radius_m = radius_of(disc, cost) - required_m;
    groups.push_back({disc.centre, {{disc.centre, std::max(0.0, radius_m)}}});
  }
  std::vector<Vector2> representatives;
  for (const ObstacleGroup& group : groups) representatives.push_back(group.representative);
  return {std::move(groups), Cuts<2>(representatives)};
}

/// The terrain and the discs.
class TravelSpace : public StaticSpace<2> {
 public:
  TravelSpace(const TravelCost& cost, const Cuts<2>& cuts)
      : StaticSpace<2>(cost.terrain().field(), cuts, cost.terrain().bounds(), cost.start(),
                       {cost.rules().required_clearance_m, cost.rules().escape_radius_m}),
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
                      const WayRules& rules) {
#ifdef MOCHA_WITH_CGAL
  if (rules.roadmap == RoadmapKind::kApollonius) {
    const double required_m = rules.travel.required_clearance_m;
    const double relaxed_m = std::max(kNarrowest * required_m, required_m - kCircleError_m);
    return apollonius_roadmap(scenery.groups, cost.terrain().bounds(), cost.start(), goal,
                              {relaxed_m, rules.travel.escape_radius_m});
  }
#endif
  VisibilityPrmRules prm;
  prm.samples = rules.prm_samples;
  return visibility_prm<2>(TravelSpace(cost, scenery.cuts), cost.start(), goal, prm);
}

/// From the start that `cost` knows.
std::vector<std::vector<Vector2>> paths_of_classes(const TravelCost& cost, const Scenery& scenery,
                                                   const Vector2& goal, const WayRules& rules) {
  Roadmap<2> roadmap = roadmap_of(cost, scenery, goal, rules);
  price(roadmap, cost);
  roadmap = contracted(roadmap);
  add_shortcuts(roadmap, cost);
  std::vector<std::vector<Vector2>> paths;
  for (auto& path :
       shortest_classes(roadmap, scenery.cuts, {kSpare * rules.classes, rules.longest_ratio}))
    paths.push_back(std::move(path.points));
  if (!paths.empty()) return paths;
  // Too narrow for the roadmap's circles, perhaps; the lattice is slower, but misses nothing.
  GridPath path = find_grid_path(cost.terrain(), cost.start(), goal, cost, rules.lattice_step_m);
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

/// Makes a way of each path, as cheap as its class allows.
std::vector<Way> ways_along(const std::vector<std::vector<Vector2>>& paths, const TravelCost& cost,
                            const Cuts<2>& cuts, const std::vector<Vector2>& lead_in) {
  const Signature before = signature_of<2>(cuts, lead_in);
  std::vector<Way> ways(paths.size());
  tbb::parallel_for(std::size_t{0}, paths.size(), [&](std::size_t i) {
    Way& way = ways[i];
    way.points = shortened(paths[i], cost, cuts);
    way.cost_m = cost_of(way.points, cost);
    way.signature = signature_of<2>(cuts, way.points);
    std::transform(before.begin(), before.end(), way.signature.begin(), way.signature.begin(),
                   std::plus<int>());
    way.least_length_m = least_length_m(way.points, cost.terrain().field());
  });
  return ways;
}

/// Of each class the cheapest, cheapest first; what is driven stays in any case.
void keep_best(std::vector<Way>& ways, const std::optional<Signature>& driven,
               const WayRules& rules) {
  std::stable_sort(ways.begin(), ways.end(),
                   [](const Way& a, const Way& b) { return a.cost_m < b.cost_m; });
  std::vector<Way> kept;
  for (Way& way : ways) {
    const auto twin = std::find_if(kept.begin(), kept.end(), [&](const Way& other) {
      return other.signature == way.signature;
    });
    if (twin != kept.end()) continue;
    const bool good = static_cast<int>(kept.size()) < rules.classes &&
                      way.cost_m <= rules.longest_ratio * ways.front().cost_m;
    if (good || way.signature == driven) kept.push_back(std::move(way));
  }
  ways = std::move(kept);
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

Ways find_ways(const Terrain& terrain, const WayQuery& query, const WayRules& rules) {
  const Vector2& start = query.start();
  const TravelCost cost(terrain, start, query.blocked, rules.travel);
  Ways result;
  result.outcome = GridPath::Outcome::kStartBlocked;
  if (!terrain.bounds().contains(start) || cost.at(start) == TravelCost::kInfinity) return result;
  result.outcome = GridPath::Outcome::kGoalBlocked;
  if (!terrain.bounds().contains(query.goal) || cost.at(query.goal) == TravelCost::kInfinity)
    return result;
  const Scenery scenery = scenery_of(cost);
  std::vector<std::vector<Vector2>> paths = paths_of_classes(cost, scenery, query.goal, rules);
  const std::vector<Vector2> driven = still_drivable(query.driven, cost);
  if (query.lead_in.size() == 1 && !driven.empty()) paths.push_back(driven);
  result.ways = ways_along(paths, cost, scenery.cuts, query.lead_in);
  if (!query.driven.empty()) result.driven = signature_of<2>(scenery.cuts, query.driven);
  keep_best(result.ways, result.driven, rules);
  result.cuts = scenery.cuts;
  result.outcome = result.ways.empty() ? GridPath::Outcome::kNoPath : GridPath::Outcome::kFound;
  return result;
}

}  // namespace mocha
