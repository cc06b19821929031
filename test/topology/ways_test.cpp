#include "topology/ways.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "topology/class_search.h"
#include "topology/grid_world.h"
#include "topology/visibility_prm.h"
#include "world/world_file.h"

namespace mocha {
namespace {

using Outcome = GridPath::Outcome;

/// The kinds that were built.
std::vector<RoadmapKind> kinds() {
  const RoadmapKind best = roadmap_kind("best");
  if (best == RoadmapKind::kVisibilityPrm) return {best};
  return {best, RoadmapKind::kVisibilityPrm};
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
  std::shared_ptr<const Terrain> terrain;
  Vector2 start{1.0, 1.0};
  Vector2 goal{14.8, 10.8};

  Rooms() {
    const World world = load_world("config/worlds/rooms.yaml", "config");
    OccupancyGrid grid = free_grid(world.bounds.min(), world.bounds.max());
    for (const Polygon& polygon : world.polygons)
      fill_polygon(grid, polygon, OccupancyGrid::kOccupied);
    for (const Circle& circle : world.circles)
      fill_disc(grid, circle.centre, circle.radius_m, OccupancyGrid::kOccupied);
    terrain = terrain_of(grid);
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
  WayQuery query;
  WayRules rules;

  Hall() {
    query.lead_in = {{1.0, 3.0}};
    query.goal = {7.0, 3.0};
  }
  Ways ways(RoadmapKind kind) {
    rules.roadmap = kind;
    return find_ways(*terrain_of(grid), query, rules);
  }
};

void expect_sound(const Ways& found, const WayQuery& query, const Terrain& terrain,
                  const WayRules& rules) {
  ASSERT_EQ(found.outcome, Outcome::kFound);
  ASSERT_FALSE(found.ways.empty());
  const TravelCost cost(terrain, query.start(), query.blocked, rules.travel);
  std::set<Signature> classes;
  for (std::size_t i = 0; i < found.ways.size(); ++i) {
    const Way& way = found.ways[i];
    EXPECT_EQ(way.points.front(), query.start());
    EXPECT_EQ(way.points.back(), query.goal);
    EXPECT_TRUE(std::isfinite(way.cost_m));
    EXPECT_NEAR(way.cost_m, cost_of(way.points, cost), 1e-9);
    EXPECT_LE(way.least_length_m, way.cost_m + 1e-9);
    EXPECT_TRUE(classes.insert(way.signature).second);
    std::vector<Vector2> whole = query.lead_in;
    whole.insert(whole.end(), way.points.begin(), way.points.end());
    EXPECT_EQ(signature_of<2>(found.cuts, whole), way.signature);
    if (i > 0) {
      EXPECT_GE(way.cost_m, found.ways[i - 1].cost_m);
    }
  }
}

std::set<std::string> routes(const Ways& found) {
  std::set<std::string> routes;
  for (const Way& way : found.ways) routes.insert(Rooms::route(way.points));
  return routes;
}

TEST(Ways, GoThroughTheRoomsByAllDoorsThatAPersonWouldName) {
  const Rooms rooms;
  WayRules rules;
  rules.classes = 12;
  WayQuery query;
  query.lead_in = {rooms.start};
  query.goal = rooms.goal;
  const std::string by_north_west = "sw-corridor nw-corridor nw-n n-ne ";
  const std::set<std::string> round_the_pillar = {by_north_west, "sw-corridor n-corridor n-ne ",
                                                  "s-corridor n-corridor sw-s n-ne "};
  std::set<std::string> along_the_corridor = round_the_pillar;
  along_the_corridor.insert({"sw-corridor ne-corridor ", "s-corridor ne-corridor sw-s "});
  for (const RoadmapKind kind : kinds()) {
    rules.roadmap = kind;
    rules.travel.required_clearance_m = 0.3;
    const Ways found = find_ways(*rooms.terrain, query, rules);
    expect_sound(found, query, *rooms.terrain, rules);
    // The corridor's pillar leaves 0.7 m on both sides.
    rules.travel.required_clearance_m = 0.36;
    const Ways wide = find_ways(*rooms.terrain, query, rules);
    expect_sound(wide, query, *rooms.terrain, rules);
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
TEST(Ways, SamplesFindMostDoors) {
  const Rooms rooms;
  const double clearance_m = 0.3;
  std::vector<Vector2> feet;
  for (const ObstacleGroup& group : rooms.terrain->groups(clearance_m))
    feet.push_back(group.representative);
  const Cuts<2> cuts(feet);
  std::size_t classes = 0;
  VisibilityPrmRules prm;
  prm.samples = 1000;
  for (prm.seed = 1; prm.seed <= 20; ++prm.seed) {
    const Roadmap<2> roadmap =
        visibility_prm<2>(rooms.terrain->field(), cuts, rooms.terrain->bounds(), rooms.start,
                          rooms.goal, {clearance_m, 0.6}, prm);
    classes += shortest_classes(roadmap, cuts, {50, 1.5}).size();
  }
  EXPECT_GE(classes, 20u * 11u);
}

TEST(Ways, AreNoMoreThanAskedAndNoneMuchDearerThanTheCheapest) {
  const Rooms rooms;
  WayQuery query;
  query.lead_in = {rooms.start};
  query.goal = rooms.goal;
  WayRules rules;
  rules.roadmap = roadmap_kind("best");
  const double cheapest = find_ways(*rooms.terrain, query, rules).ways.front().cost_m;
  for (const int classes : {1, 2, 4}) {
    rules.classes = classes;
    const Ways found = find_ways(*rooms.terrain, query, rules);
    EXPECT_LE(static_cast<int>(found.ways.size()), classes);
    EXPECT_NEAR(found.ways.front().cost_m, cheapest, 0.01 * cheapest);
  }
  rules.classes = 50;
  rules.longest_ratio = 1.15;
  for (const Way& way : find_ways(*rooms.terrain, query, rules).ways)
    EXPECT_LE(way.cost_m, 1.15 * cheapest + 1e-6);
}

TEST(Ways, KeepTheClassThatIsDrivenEvenWhereItIsDear) {
  Hall hall;
  fill_box(hall.grid, {4.0, 0.0}, {4.2, 2.8});
  fill_box(hall.grid, {4.0, 3.6}, {4.2, 5.0});
  hall.rules.classes = 1;
  hall.rules.longest_ratio = 1.05;
  for (const RoadmapKind kind : kinds()) {
    hall.query.driven.clear();
    const Ways without = hall.ways(kind);
    expect_sound(without, hall.query, *terrain_of(hall.grid), hall.rules);
    EXPECT_FALSE(without.driven);
    hall.query.driven = {{1.0, 3.0}, {1.0, 5.5}, {7.0, 5.5}, {7.0, 3.0}};
    const Ways found = hall.ways(kind);
    expect_sound(found, hall.query, *terrain_of(hall.grid), hall.rules);
    ASSERT_TRUE(found.driven);
    EXPECT_EQ(*found.driven, signature_of<2>(found.cuts, hall.query.driven));
    ASSERT_EQ(found.ways.size(), 2u) << "the cheapest and the driven";
    EXPECT_EQ(found.ways.back().signature, *found.driven);
    EXPECT_LT(found.ways.back().cost_m, 10.0) << "shortened like others";
    // What is blocked by now is not kept.
    fill_box(hall.grid, {4.0, 5.0}, {4.2, 6.0});
    const Ways blocked = hall.ways(kind);
    EXPECT_EQ(blocked.ways.size(), 1u);
    EXPECT_EQ(blocked.outcome, Outcome::kFound);
    fill_box(hall.grid, {4.0, 5.0}, {4.2, 6.0}, OccupancyGrid::kFree);
  }
}

TEST(Ways, CountWhatIsDrivenBeforeThemForTheirClass) {
  Hall hall;
  fill_box(hall.grid, {3.9, 2.9}, {4.1, 3.1});
  for (const RoadmapKind kind : kinds()) {
    hall.query.lead_in = {{1.0, 3.0}};
    const Ways direct = hall.ways(kind);
    std::vector<Vector2> above = {{1.0, 3.0}, {4.0, 4.0}, {5.5, 3.5}};
    hall.query.lead_in = above;
    const Ways after = hall.ways(kind);
    expect_sound(after, hall.query, *terrain_of(hall.grid), hall.rules);
    EXPECT_EQ(after.ways.front().points.front(), above.back());
    std::vector<Vector2> all = above;
    all.push_back(hall.query.goal);
    EXPECT_EQ(after.ways.front().signature, signature_of<2>(direct.cuts, all));
    EXPECT_NE(after.ways.front().signature, Signature(1, 0)) << "it passes above the post";
  }
}

TEST(Ways, PassABlockedDiscOnEitherSide) {
  Hall hall;
  hall.query.blocked = {{{4.0, 3.0}, 0.8}};
  for (const RoadmapKind kind : kinds()) {
    const Ways found = hall.ways(kind);
    expect_sound(found, hall.query, *terrain_of(hall.grid), hall.rules);
    ASSERT_EQ(found.ways.size(), 2u);
    std::set<bool> above;
    for (const Way& way : found.ways) {
      for (std::size_t i = 1; i < way.points.size(); ++i) {
        const Vector2 near = nearest_on_segment({4.0, 3.0}, way.points[i - 1], way.points[i]);
        EXPECT_GT((near - Vector2(4.0, 3.0)).norm(), 0.8 - 0.002);
      }
      above.insert(crosses(way.points, {4.0, 3.0}, {4.0, 6.0}));
    }
    EXPECT_EQ(above.size(), 2u);
  }
}

TEST(Ways, PassABlockedDiscThatLeavesLittleRoom) {
  Hall hall;
  fill_box(hall.grid, {0.0, 0.0}, {8.0, 0.2});
  fill_box(hall.grid, {0.0, 5.8}, {8.0, 6.0});
  hall.query.blocked = {{{4.0, 3.0}, 2.4}};  // which leaves 10 cm to the robot's centre
  const RoadmapKind best = roadmap_kind("best");
  const Ways found = hall.ways(best);
  expect_sound(found, hall.query, *terrain_of(hall.grid), hall.rules);
  if (best == RoadmapKind::kApollonius) {
    EXPECT_EQ(found.ways.size(), 2u);
  }
  hall.query.blocked[0].radius_m = 2.6;
  EXPECT_EQ(hall.ways(best).outcome, Outcome::kNoPath);
}

TEST(Ways, LeadOutOfADiscThatOneStandsIn) {
  Hall hall;
  hall.query.blocked = {{{1.5, 3.0}, 0.8}};
  for (const RoadmapKind kind : kinds()) {
    const Ways found = hall.ways(kind);
    expect_sound(found, hall.query, *terrain_of(hall.grid), hall.rules);
    EXPECT_EQ(found.ways.size(), 2u) << "on both sides of it";
  }
}

TEST(Ways, SayWhatIsBlocked) {
  Hall hall;
  fill_box(hall.grid, {3.0, 2.0}, {5.0, 4.0});
  for (const RoadmapKind kind : kinds()) {
    hall.query.lead_in = {{1.0, 3.0}};
    hall.query.goal = {4.0, 3.0};
    EXPECT_EQ(hall.ways(kind).outcome, Outcome::kGoalBlocked);
    hall.query.goal = {5.1, 3.0};
    EXPECT_EQ(hall.ways(kind).outcome, Outcome::kGoalBlocked);
    hall.query.goal = {9.0, 3.0};
    EXPECT_EQ(hall.ways(kind).outcome, Outcome::kGoalBlocked) << "beyond the map";
    hall.query.goal = {7.0, 3.0};
    hall.query.blocked = {{{7.2, 3.0}, 0.5}};
    EXPECT_EQ(hall.ways(kind).outcome, Outcome::kGoalBlocked);
    hall.query.blocked.clear();
    hall.query.lead_in = {{4.0, 3.0}};
    EXPECT_EQ(hall.ways(kind).outcome, Outcome::kStartBlocked);
    hall.query.lead_in = {{-1.0, 3.0}};
    EXPECT_EQ(hall.ways(kind).outcome, Outcome::kStartBlocked);
    EXPECT_TRUE(hall.ways(kind).ways.empty());
    hall.query.lead_in = {{2.9, 3.0}};  // too close, but may leave
    EXPECT_EQ(hall.ways(kind).outcome, Outcome::kFound);
  }
  fill_box(hall.grid, {3.0, 0.0}, {5.0, 6.0});
  hall.query.lead_in = {{1.0, 3.0}};
  for (const RoadmapKind kind : kinds()) {
    const Ways none = hall.ways(kind);
    EXPECT_EQ(none.outcome, Outcome::kNoPath);
    EXPECT_TRUE(none.ways.empty());
  }
}

TEST(Ways, LeadNowhereFromTheStartToTheStart) {
  Hall hall;
  hall.query.goal = hall.query.start();
  for (const RoadmapKind kind : kinds()) {
    const Ways found = hall.ways(kind);
    ASSERT_EQ(found.outcome, Outcome::kFound);
    EXPECT_EQ(found.ways.front().cost_m, 0.0);
  }
}

TEST(Ways, AreFoundOnTheLatticeWhereTheRoadmapHasNone) {
  // A crooked passage just wide enough, which hardly any of a few samples meets.
  Hall hall;
  fill_box(hall.grid, {2.0, 0.0}, {6.0, 6.0});
  fill_box(hall.grid, {2.0, 0.5}, {3.0, 1.2}, OccupancyGrid::kFree);
  fill_box(hall.grid, {2.3, 0.5}, {3.0, 5.0}, OccupancyGrid::kFree);
  fill_box(hall.grid, {2.3, 4.3}, {6.0, 5.0}, OccupancyGrid::kFree);
  hall.rules.prm_samples = 0;
  const Ways found = hall.ways(RoadmapKind::kVisibilityPrm);
  expect_sound(found, hall.query, *terrain_of(hall.grid), hall.rules);
  EXPECT_EQ(found.ways.size(), 1u);
}

/// A start between two crates, closer to each other than the robot would go: it may leave on both
/// sides, and one of the two crates is passed on either side.
TEST(Ways, FromANarrowStartLeadOutOnBothSides) {
  for (const bool goal_is_above : {true, false}) {
    Hall hall;
    fill_box(hall.grid, {2.0, 2.0}, {2.5, 2.78});
    fill_box(hall.grid, {2.0, 3.22}, {2.5, 4.0});
    hall.query.lead_in = {{2.25, 2.95}};
    hall.query.goal = {2.25, goal_is_above ? 5.0 : 1.0};
    for (const RoadmapKind kind : kinds()) {
      const Ways found = hall.ways(kind);
      expect_sound(found, hall.query, *terrain_of(hall.grid), hall.rules);
      EXPECT_GE(found.ways.size(), 2u) << goal_is_above << " " << int(kind);
    }
  }
}

TEST(Ways, KnowRoadmapsByTheirNames) {
  EXPECT_EQ(roadmap_kind("visibility_prm"), RoadmapKind::kVisibilityPrm);
  EXPECT_THROW(roadmap_kind("voronoi"), std::invalid_argument);
  EXPECT_THROW(roadmap_kind(""), std::invalid_argument);
  if (roadmap_kind("best") == RoadmapKind::kApollonius) {
    EXPECT_EQ(roadmap_kind("apollonius"), RoadmapKind::kApollonius);
  } else {
    EXPECT_THROW(roadmap_kind("apollonius"), std::invalid_argument);
  }
}

}  // namespace
}  // namespace mocha
