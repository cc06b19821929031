#include "topology/paths/class_roadmap.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#ifdef MOCHA_WITH_CGAL
#include "topology/roadmaps/apollonius_roadmap.h"
#endif
#include "topology/roadmaps/map_skeleton.h"
#include "topology/roadmaps/roadmap_simplification.h"
#include "topology/roadmaps/static_space.h"
#include "topology/roadmaps/visibility_prm.h"

namespace mocha {
namespace {

#ifdef MOCHA_WITH_CGAL
constexpr bool kHaveApollonius = true;
#else
constexpr bool kHaveApollonius = false;
#endif
constexpr double kCircleError_m = 0.12;  // of the circles that stand for solid matter, at most
constexpr std::uint64_t kSeed = 1;       // of the sampled roadmap
constexpr double kReach_m = 20.0;        // its edges are no longer

/// A path that begins inside may leave.
double radius_of(const BlockedDisc& disc, const TravelCost& cost) {
  return std::min(disc.radius_m, (cost.start() - disc.centre).norm());
}

std::vector<ObstacleGroup> groups_of(const TravelCost& cost) {
  const double required_m = cost.options().required_clearance_m;
  // What one starts between can be passed, though it be too narrow elsewhere.
  const double start_m = cost.static_map().field().sample(cost.start()).distance_m;
  std::vector<ObstacleGroup> groups =
      cost.static_map().groups(std::clamp(start_m, kNarrowestPassage * required_m, required_m));
  for (const BlockedDisc& disc : cost.blocked()) {
    const double radius_m = radius_of(disc, cost) - required_m;
    groups.push_back({disc.centre, {{disc.centre, std::max(0.0, radius_m)}}});
  }
  return groups;
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

/// Of circles or samples, which only stand for the static map: to be priced and simplified.
Roadmap<2> rough_roadmap(const TravelCost& cost, const std::vector<ObstacleGroup>& groups,
                         const Cuts<2>& cuts, const Vector2& goal, bool apollonius,
                         int prm_samples) {
#ifdef MOCHA_WITH_CGAL
  if (apollonius) {
    const double required_m = cost.options().required_clearance_m;
    const double relaxed_m = std::max(kNarrowestPassage * required_m, required_m - kCircleError_m);
    return apollonius_roadmap(groups, cost.static_map().bounds(), cost.start(), goal,
                              {relaxed_m, cost.options().escape_radius_m});
  }
#endif
  return visibility_prm<2>(TravelSpace(cost, cuts), cost.start(), goal,
                           {prm_samples, kSeed, kReach_m});
}

ClassRoadmap on_skeleton(const MapSkeleton& skeleton, const TravelCost& cost, const Vector2& goal,
                         const std::function<bool()>& should_stop) {
  if (!skeleton.complete(cost, should_stop)) return {{}, Cuts<2>({})};
  std::vector<Vector2> representatives = skeleton.obstacles();
  for (const BlockedDisc& disc : cost.blocked()) representatives.push_back(disc.centre);
  return {skeleton.roadmap(cost, goal), Cuts<2>(representatives)};
}

}  // namespace

RoadmapKind roadmap_kind(const std::string& name) {
  if (name == "visibility_prm") return RoadmapKind::kVisibilityPrm;
  if (name == "best") return RoadmapKind::kBest;
  if (name != "apollonius") {
    throw std::invalid_argument("roadmap = " + name + ", one of best, apollonius, visibility_prm");
  }
  if (!kHaveApollonius) throw std::invalid_argument("roadmap = apollonius: built without CGAL");
  return RoadmapKind::kApollonius;
}

ClassRoadmap class_roadmap(const TravelCost& cost, const Vector2& goal, RoadmapKind kind,
                           int prm_samples, const std::function<bool()>& should_stop) {
  if (kind == RoadmapKind::kBest) {
    if (const auto skeleton = cost.static_map().skeleton(cost.options()))
      return on_skeleton(*skeleton, cost, goal, should_stop);
  }
  const std::vector<ObstacleGroup> groups = groups_of(cost);
  std::vector<Vector2> representatives;
  for (const ObstacleGroup& group : groups) representatives.push_back(group.representative);
  Cuts<2> cuts(representatives);
  const bool apollonius = kHaveApollonius && kind != RoadmapKind::kVisibilityPrm;
  Roadmap<2> roadmap = rough_roadmap(cost, groups, cuts, goal, apollonius, prm_samples);
  price(roadmap, cost);
  roadmap = contracted(roadmap);
  add_shortcuts(roadmap, cost);
  return {std::move(roadmap), std::move(cuts)};
}

}  // namespace mocha
