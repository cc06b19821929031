#include "topology/paths/homotopy_paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "topology/grid_world.h"
#include "topology/paths/class_search.h"
#include "topology/roadmaps/visibility_prm.h"
#include "topology/shipped_options.h"
#include "world/world_file.h"

namespace mocha {
namespace {

using Outcome = GridPath::Outcome;

/// The kinds that were built.
std::vector<RoadmapKind> kinds() {
  std::vector<RoadmapKind> kinds = {RoadmapKind::kBest, RoadmapKind::kVisibilityPrm};
  try {
    kinds.push_back(roadmap_kind("apollonius"));
  } catch (const std::invalid_argument&) {  // without CGAL
  }
  return kinds;
}

bool crosses(const std::vector<Vector2>& path, const Vector2& a, const Vector2& b) {
  const auto side = [](const Vector2& p, const Vector2& q, const Vector2& r) {
    return (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x()) > 0.0;
  };
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vector2& p = path[i - 1];
    const Vector2& q = path[i];
    if (side(a, b, p) != side(a, b, q) && side(p, q, a) != side(p, q, b)) return true;
  }
  return false;
}

/// The world of rooms as a map, and its doors.
struct Rooms {
  std::shared_ptr<const StaticMap> static_map;
  Vector2 start{1.0, 1.0};
  Vector2 goal{14.8, 10.8};

  Rooms() {
    const World world = load_world("config/worlds/rooms.yaml", "config");
    OccupancyGrid grid = free_grid(world.bounds.min(), world.bounds.max());
    for (const Polygon& polygon : world.polygons)
      fill_polygon(grid, polygon, OccupancyGrid::kOccupied);
    for (const Circle& circle : world.circles)
      fill_disc(grid, circle.centre, circle.radius_m, OccupancyGrid::kOccupied);
    static_map = static_map_of(grid);
  }

  struct Door {
    const char* name;
    Vector2 from;
    Vector2 to;
  };
  static std::vector<Door> doors() {
    return {{"sw-corridor ", {2.0, 5.0}, {3.1, 5.0}},   {"s-corridor ", {7.5, 5.0}, {8.6, 5.0}},
            {"se-corridor ", {13.0, 5.0}, {14.1, 5.0}}, {"nw-corridor ", {2.5, 7.0}, {3.6, 7.0}},
            {"n-corridor ", {8.0, 7.0}, {9.1, 7.0}},    {"ne-corridor ", {12.5, 7.0}, {13.6, 7.0}},
            {"sw-s ", {5.3, 2.0}, {5.3, 3.1}},          {"nw-n ", {5.3, 9.0}, {5.3, 10.1}},
            {"n-ne ", {10.7, 9.5}, {10.7, 10.6}}};
  }
  /// By which doors, in the order of doors().
  static std::string route(const std::vector<Vector2>& path) {
    std::string names;
    for (const Door& door : doors())
      if (crosses(path, door.from, door.to)) names += door.name;
    return names;
  }
};

struct Hall {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
  HomotopyPathQuery query;
  HomotopyPathOptions options = shipped_path_options();

  Hall() {
    query.lead_in = {{1.0, 3.0}};
    query.goal = {7.0, 3.0};
  }
  HomotopyPaths paths(RoadmapKind kind) {
    options.roadmap = kind;
    return find_homotopy_paths(*static_map_of(grid), query, options);
  }
};

void expect_sound(const HomotopyPaths& found, const HomotopyPathQuery& query,
                  const StaticMap& static_map, const HomotopyPathOptions& options) {
  ASSERT_EQ(found.outcome, Outcome::kFound);
  ASSERT_FALSE(found.paths.empty());
  const TravelCost cost(static_map, query.start(), query.blocked, options.travel);
  std::set<Signature> classes;
  for (std::size_t i = 0; i < found.paths.size(); ++i) {
    const HomotopyPath& path = found.paths[i];
    EXPECT_EQ(path.points.front(), query.start());
    EXPECT_EQ(path.points.back(), query.goal);
    EXPECT_TRUE(std::isfinite(path.cost_m));
    EXPECT_NEAR(path.cost_m, cost_of(path.points, cost), 1e-9);
    EXPECT_LE(path.least_length_m, path.cost_m + 1e-9);
    EXPECT_TRUE(classes.insert(path.signature).second);
    std::vector<Vector2> whole = query.lead_in;
    whole.insert(whole.end(), path.points.begin(), path.points.end());
    EXPECT_EQ(signature_of<2>(found.cuts, whole), path.signature);
    if (i > 0) {
      EXPECT_GE(path.cost_m, found.paths[i - 1].cost_m);
    }
  }
}

std::set<std::string> routes(const HomotopyPaths& found) {
  std::set<std::string> routes;
  for (const HomotopyPath& path : found.paths) routes.insert(Rooms::route(path.points));
  return routes;
}

TEST(HomotopyPaths, GoThroughTheRoomsByAllDoorsThatAPersonWouldName) {
  const Rooms rooms;
  HomotopyPathOptions options = shipped_path_options();
  options.classes = 12;
  HomotopyPathQuery query;
  query.lead_in = {rooms.start};
  query.goal = rooms.goal;
  const std::string by_north_west = "sw-corridor nw-corridor nw-n n-ne ";
  const std::set<std::string> round_the_pillar = {by_north_west, "sw-corridor n-corridor n-ne ",
                                                  "s-corridor n-corridor sw-s n-ne "};
  std::set<std::string> along_the_corridor = round_the_pillar;
  along_the_corridor.insert({"sw-corridor ne-corridor ", "s-corridor ne-corridor sw-s "});
  for (const RoadmapKind kind : kinds()) {
    options.roadmap = kind;
    options.travel.required_clearance_m = 0.3;
    const HomotopyPaths found = find_homotopy_paths(*rooms.static_map, query, options);
    expect_sound(found, query, *rooms.static_map, options);
    // The corridor's pillar leaves 0.7 m on both sides.
    options.travel.required_clearance_m = 0.36;
    const HomotopyPaths wide = find_homotopy_paths(*rooms.static_map, query, options);
    expect_sound(wide, query, *rooms.static_map, options);
    for (const std::string& route : routes(wide))
      EXPECT_EQ(route.find("ne-corridor"), std::string::npos) << route;
    if (kind == RoadmapKind::kApollonius) {
      EXPECT_EQ(routes(found), along_the_corridor);
      for (const std::string& route : round_the_pillar) EXPECT_TRUE(routes(wide).count(route));
    } else {
      // Samples miss some of the doors.
      EXPECT_GE(routes(found).size(), 3u);
    }
  }
}

/// Of a thousand samples, few meet the doors unless those between door posts are sought.
TEST(HomotopyPaths, SamplesFindMostDoors) {
  const Rooms rooms;
  const double clearance_m = 0.3;
  std::vector<Vector2> feet;
  for (const ObstacleGroup& group : rooms.static_map->groups(clearance_m))
    feet.push_back(group.representative);
  const Cuts<2> cuts(feet);
  std::size_t classes = 0;
  VisibilityPrmOptions prm = prm_options(1000);
  for (prm.seed = 1; prm.seed <= 20; ++prm.seed) {
    const Roadmap<2> roadmap =
        visibility_prm<2>(rooms.static_map->field(), cuts, rooms.static_map->bounds(), rooms.start,
                          rooms.goal, {clearance_m, 0.6}, prm);
    classes += shortest_classes(roadmap, cuts, {50, 1.5}).size();
  }
  EXPECT_GE(classes, 20u * 11u);
}

TEST(HomotopyPaths, AreNoMoreThanAskedAndNoneMuchDearerThanTheCheapest) {
  const Rooms rooms;
  HomotopyPathQuery query;
  query.lead_in = {rooms.start};
  query.goal = rooms.goal;
  HomotopyPathOptions options = shipped_path_options();
  options.roadmap = roadmap_kind("best");
  const double cheapest =
      find_homotopy_paths(*rooms.static_map, query, options).paths.front().cost_m;
  for (const int classes : {1, 2, 4}) {
    options.classes = classes;
    const HomotopyPaths found = find_homotopy_paths(*rooms.static_map, query, options);
    EXPECT_LE(static_cast<int>(found.paths.size()), classes);
    EXPECT_NEAR(found.paths.front().cost_m, cheapest, 0.01 * cheapest);
  }
  options.classes = 50;
  options.longest_ratio = 1.15;
  for (const HomotopyPath& path : find_homotopy_paths(*rooms.static_map, query, options).paths)
    EXPECT_LE(path.cost_m, 1.15 * cheapest + 1e-6);
}

TEST(HomotopyPaths, KeepTheClassThatIsDrivenEvenWhereItIsDear) {
  Hall hall;
  fill_box(hall.grid, {4.0, 0.0}, {4.2, 2.8});
  fill_box(hall.grid, {4.0, 3.6}, {4.2, 5.0});
  hall.options.classes = 1;
  hall.options.longest_ratio = 1.05;
  for (const RoadmapKind kind : kinds()) {
    hall.query.driven.clear();
    const HomotopyPaths without = hall.paths(kind);
    expect_sound(without, hall.query, *static_map_of(hall.grid), hall.options);
    EXPECT_FALSE(without.driven);
    hall.query.driven = {{1.0, 3.0}, {1.0, 5.5}, {7.0, 5.5}, {7.0, 3.0}};
    const HomotopyPaths found = hall.paths(kind);
    expect_sound(found, hall.query, *static_map_of(hall.grid), hall.options);
    ASSERT_TRUE(found.driven);
    EXPECT_EQ(*found.driven, signature_of<2>(found.cuts, hall.query.driven));
    ASSERT_EQ(found.paths.size(), 2u) << "the cheapest and the driven";
    EXPECT_EQ(found.paths.back().signature, *found.driven);
    EXPECT_LT(found.paths.back().cost_m, 10.0) << "shortened like others";
    // What is blocked by now is not kept.
    fill_box(hall.grid, {4.0, 5.0}, {4.2, 6.0});
    const HomotopyPaths blocked = hall.paths(kind);
    EXPECT_EQ(blocked.paths.size(), 1u);
    EXPECT_EQ(blocked.outcome, Outcome::kFound);
    fill_box(hall.grid, {4.0, 5.0}, {4.2, 6.0}, OccupancyGrid::kFree);
  }
}

TEST(HomotopyPaths, WithinALimitAreTheDrivenOneAndThoseThatMayBeMuchCheaper) {
  Hall hall;
  fill_box(hall.grid, {4.0, 0.0}, {4.2, 2.8});
  fill_box(hall.grid, {4.0, 3.6}, {4.2, 5.0});
  const std::vector<Vector2> detour = {{1.0, 3.0}, {1.0, 5.5}, {7.0, 5.5}, {7.0, 3.0}};
  const std::vector<Vector2> straight = {{1.0, 3.0}, {3.5, 3.2}, {5.0, 3.2}, {7.0, 3.0}};
  for (const RoadmapKind kind : kinds()) {
    hall.query.driven = detour;
    hall.query.below_driven = 1.0;
    EXPECT_EQ(hall.paths(kind).paths.size(), 2u) << "straight on is much cheaper";
    hall.query.driven = straight;
    const HomotopyPaths found = hall.paths(kind);
    ASSERT_EQ(found.paths.size(), 1u);
    EXPECT_EQ(found.paths[0].signature, *found.driven);
    fill_box(hall.grid, {4.0, 2.8}, {4.2, 3.6});
    EXPECT_TRUE(hall.paths(kind).paths.empty()) << "the driven one is blocked";
    hall.query.below_driven.reset();
    EXPECT_FALSE(hall.paths(kind).paths.empty());
    fill_box(hall.grid, {4.0, 2.8}, {4.2, 3.6}, OccupancyGrid::kFree);
  }
}

TEST(HomotopyPaths, SayWhetherTheyAreOfTheLattice) {
  Hall hall;
  fill_box(hall.grid, {4.0, 0.0}, {4.2, 4.6});
  fill_box(hall.grid, {4.0, 5.4}, {4.2, 6.0});
  for (const RoadmapKind kind : kinds()) {
    for (const HomotopyPath& path : hall.paths(kind).paths) EXPECT_FALSE(path.narrowest_on_lattice);
  }
  hall.options.prm_samples = 1;
  HomotopyPaths found = hall.paths(RoadmapKind::kVisibilityPrm);
  expect_sound(found, hall.query, *static_map_of(hall.grid), hall.options);
  ASSERT_EQ(found.paths.size(), 1u);
  ASSERT_TRUE(found.paths[0].narrowest_on_lattice);
  EXPECT_LT((*found.paths[0].narrowest_on_lattice - Vector2(4.1, 5.0)).norm(), 0.3);
  hall.query.driven = {{1.0, 3.0}, {3.5, 5.0}, {4.7, 5.0}, {7.0, 3.0}};
  hall.query.below_driven = 1.0;
  found = hall.paths(RoadmapKind::kVisibilityPrm);
  ASSERT_EQ(found.paths.size(), 1u);
  EXPECT_FALSE(found.paths[0].narrowest_on_lattice) << "it is the one that is driven";
}

TEST(HomotopyPaths, CountWhatIsDrivenBeforeThemForTheirClass) {
  Hall hall;
  fill_box(hall.grid, {3.9, 2.9}, {4.1, 3.1});
  for (const RoadmapKind kind : kinds()) {
    hall.query.lead_in = {{1.0, 3.0}};
    const HomotopyPaths direct = hall.paths(kind);
    std::vector<Vector2> above = {{1.0, 3.0}, {4.0, 4.0}, {5.5, 3.5}};
    hall.query.lead_in = above;
    const HomotopyPaths after = hall.paths(kind);
    expect_sound(after, hall.query, *static_map_of(hall.grid), hall.options);
    EXPECT_EQ(after.paths.front().points.front(), above.back());
    std::vector<Vector2> all = above;
    all.push_back(hall.query.goal);
    EXPECT_EQ(after.paths.front().signature, signature_of<2>(direct.cuts, all));
    EXPECT_NE(after.paths.front().signature, Signature(1, 0)) << "it passes above the post";
  }
}

TEST(HomotopyPaths, PassABlockedDiscOnEitherSide) {
  Hall hall;
  hall.query.blocked = {{{4.0, 3.0}, 0.8}};
  for (const RoadmapKind kind : kinds()) {
    const HomotopyPaths found = hall.paths(kind);
    expect_sound(found, hall.query, *static_map_of(hall.grid), hall.options);
    ASSERT_EQ(found.paths.size(), 2u);
    std::set<bool> above;
    for (const HomotopyPath& path : found.paths) {
      for (std::size_t i = 1; i < path.points.size(); ++i) {
        const Vector2 near = nearest_on_segment({4.0, 3.0}, path.points[i - 1], path.points[i]);
        EXPECT_GT((near - Vector2(4.0, 3.0)).norm(), 0.8 - 0.002);
      }
      above.insert(crosses(path.points, {4.0, 3.0}, {4.0, 6.0}));
    }
    EXPECT_EQ(above.size(), 2u);
  }
}

TEST(HomotopyPaths, PassABlockedDiscThatLeavesLittleRoom) {
  Hall hall;
  fill_box(hall.grid, {0.0, 0.0}, {8.0, 0.2});
  fill_box(hall.grid, {0.0, 5.8}, {8.0, 6.0});
  hall.query.blocked = {{{4.0, 3.0}, 2.4}};  // which leaves 10 cm to the robot's centre
  const RoadmapKind best = roadmap_kind("best");
  const HomotopyPaths found = hall.paths(best);
  expect_sound(found, hall.query, *static_map_of(hall.grid), hall.options);
  if (best == RoadmapKind::kApollonius) {
    EXPECT_EQ(found.paths.size(), 2u);
  }
  hall.query.blocked[0].radius_m = 2.6;
  EXPECT_EQ(hall.paths(best).outcome, Outcome::kNoPath);
}

TEST(HomotopyPaths, LeadOutOfADiscThatOneStandsIn) {
  Hall hall;
  hall.query.blocked = {{{1.5, 3.0}, 0.8}};
  for (const RoadmapKind kind : kinds()) {
    const HomotopyPaths found = hall.paths(kind);
    expect_sound(found, hall.query, *static_map_of(hall.grid), hall.options);
    EXPECT_EQ(found.paths.size(), 2u) << "on both sides of it";
  }
}

TEST(HomotopyPaths, SayWhatIsBlocked) {
  Hall hall;
  fill_box(hall.grid, {3.0, 2.0}, {5.0, 4.0});
  for (const RoadmapKind kind : kinds()) {
    hall.query.lead_in = {{1.0, 3.0}};
    hall.query.goal = {4.0, 3.0};
    EXPECT_EQ(hall.paths(kind).outcome, Outcome::kGoalBlocked);
    hall.query.goal = {5.1, 3.0};
    EXPECT_EQ(hall.paths(kind).outcome, Outcome::kGoalBlocked);
    hall.query.goal = {9.0, 3.0};
    EXPECT_EQ(hall.paths(kind).outcome, Outcome::kGoalBlocked) << "beyond the map";
    hall.query.goal = {7.0, 3.0};
    hall.query.blocked = {{{7.2, 3.0}, 0.5}};
    EXPECT_EQ(hall.paths(kind).outcome, Outcome::kGoalBlocked);
    hall.query.blocked.clear();
    hall.query.lead_in = {{4.0, 3.0}};
    EXPECT_EQ(hall.paths(kind).outcome, Outcome::kStartBlocked);
    hall.query.lead_in = {{-1.0, 3.0}};
    EXPECT_EQ(hall.paths(kind).outcome, Outcome::kStartBlocked);
    EXPECT_TRUE(hall.paths(kind).paths.empty());
    hall.query.lead_in = {{2.9, 3.0}};  // too close, but may leave
    EXPECT_EQ(hall.paths(kind).outcome, Outcome::kFound);
  }
  fill_box(hall.grid, {3.0, 0.0}, {5.0, 6.0});
  hall.query.lead_in = {{1.0, 3.0}};
  for (const RoadmapKind kind : kinds()) {
    const HomotopyPaths none = hall.paths(kind);
    EXPECT_EQ(none.outcome, Outcome::kNoPath);
    EXPECT_TRUE(none.paths.empty());
  }
}

TEST(HomotopyPaths, LeadNowhereFromTheStartToTheStart) {
  Hall hall;
  hall.query.goal = hall.query.start();
  for (const RoadmapKind kind : kinds()) {
    const HomotopyPaths found = hall.paths(kind);
    ASSERT_EQ(found.outcome, Outcome::kFound);
    EXPECT_EQ(found.paths.front().cost_m, 0.0);
  }
}

TEST(HomotopyPaths, AreFoundOnTheLatticeWhereTheRoadmapHasNone) {
  // A crooked passage just wide enough, which hardly any of a few samples meets.
  Hall hall;
  fill_box(hall.grid, {2.0, 0.0}, {6.0, 6.0});
  fill_box(hall.grid, {2.0, 0.5}, {3.0, 1.2}, OccupancyGrid::kFree);
  fill_box(hall.grid, {2.3, 0.5}, {3.0, 5.0}, OccupancyGrid::kFree);
  fill_box(hall.grid, {2.3, 4.3}, {6.0, 5.0}, OccupancyGrid::kFree);
  hall.options.prm_samples = 0;
  const HomotopyPaths found = hall.paths(RoadmapKind::kVisibilityPrm);
  expect_sound(found, hall.query, *static_map_of(hall.grid), hall.options);
  EXPECT_EQ(found.paths.size(), 1u);
}

/// A start between two crates, closer to each other than the robot would go: it may leave on both
/// sides, and one of the two crates is passed on either side.
TEST(HomotopyPaths, FromANarrowStartLeadOutOnBothSides) {
  for (const bool goal_is_above : {true, false}) {
    Hall hall;
    fill_box(hall.grid, {2.0, 2.0}, {2.5, 2.78});
    fill_box(hall.grid, {2.0, 3.22}, {2.5, 4.0});
    hall.query.lead_in = {{2.25, 2.95}};
    hall.query.goal = {2.25, goal_is_above ? 5.0 : 1.0};
    for (const RoadmapKind kind : kinds()) {
      const HomotopyPaths found = hall.paths(kind);
      expect_sound(found, hall.query, *static_map_of(hall.grid), hall.options);
      EXPECT_GE(found.paths.size(), 2u) << goal_is_above << " " << int(kind);
    }
  }
}

TEST(HomotopyPaths, KnowRoadmapsByTheirNames) {
  EXPECT_EQ(roadmap_kind("visibility_prm"), RoadmapKind::kVisibilityPrm);
  EXPECT_THROW(roadmap_kind("voronoi"), std::invalid_argument);
  EXPECT_THROW(roadmap_kind(""), std::invalid_argument);
  EXPECT_EQ(roadmap_kind("best"), RoadmapKind::kBest);
}

}  // namespace
}  // namespace mocha
