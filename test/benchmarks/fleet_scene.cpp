#include "benchmarks/fleet_scene.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace mocha {
namespace {

constexpr double kCell_m = 0.05;
constexpr int kAttempts = 100000;

/// Uniform numbers that are the same with every standard library.
class Draw {
 public:
  explicit Draw(int seed) : engine_(0x9E3779B97F4A7C15ULL * static_cast<std::uint64_t>(seed + 1)) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1.0p-53;
  }
  Vector2 inside(const Vector2& low, const Vector2& high) {
    const double x = between(low.x(), high.x());
    return {x, between(low.y(), high.y())};
  }

 private:
  std::mt19937_64 engine_;
};

Vector2 direction(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

Pose facing(const Vector2& from, const Vector2& to) {
  return {from, std::atan2(to.y() - from.y(), to.x() - from.x())};
}

double nearest_m(const Vector2& place, const std::vector<Vector2>& others) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const Vector2& other : others) least_m = std::min(least_m, (place - other).norm());
  return least_m;
}

/// A place of a rectangle that is at least so far from all others; it becomes one of them.
Vector2 apart_from(std::vector<Vector2>& others, double apart_m, const Vector2& low,
                   const Vector2& high, Draw& draw) {
  for (int i = 0; i < kAttempts; ++i) {
    const Vector2 place = draw.inside(low, high);
    if (nearest_m(place, others) < apart_m) continue;
    others.push_back(place);
    return place;
  }
  throw std::runtime_error("fleet scene: the robots do not fit");
}

/// What is strewn over a rectangle: `count` circles with room between them, clear of `free`.
std::vector<Circle> strewn(int count, double smallest_m, double largest_m, double gap_m,
                           const std::vector<Vector2>& free, const Vector2& low,
                           const Vector2& high, Draw& draw) {
  std::vector<Circle> circles;
  for (int i = 0; i < kAttempts && static_cast<int>(circles.size()) < count; ++i) {
    const Circle circle{draw.inside(low, high), draw.between(smallest_m, largest_m)};
    const bool fits = std::all_of(circles.begin(), circles.end(), [&](const Circle& other) {
      return (other.centre - circle.centre).norm() > other.radius_m + circle.radius_m + gap_m;
    });
    if (fits && nearest_m(circle.centre, free) > circle.radius_m + gap_m) circles.push_back(circle);
  }
  if (static_cast<int>(circles.size()) < count)
    throw std::runtime_error("fleet scene: the obstacles do not fit");
  return circles;
}

OccupancyGrid free_map(const Vector2& low, const Vector2& high) {
  OccupancyGrid grid;
  grid.resolution_m = kCell_m;
  grid.origin = low;
  grid.width = static_cast<int>(std::lround((high.x() - low.x()) / kCell_m));
  grid.height = static_cast<int>(std::lround((high.y() - low.y()) / kCell_m));
  grid.cells.assign(static_cast<std::size_t>(grid.width) * grid.height, OccupancyGrid::kFree);
  return grid;
}

std::shared_ptr<const FleetMap> map_of(const std::vector<Circle>& circles, const Vector2& low,
                                       const Vector2& high) {
  OccupancyGrid grid = free_map(low, high);
  for (const Circle& circle : circles)
    fill_disc(grid, circle.centre, circle.radius_m, OccupancyGrid::kOccupied);
  return std::make_shared<const FleetMap>(grid);
}

}  // namespace

FleetWorld five_agents(int seed) {
  constexpr double kSide_m = 20.0;
  constexpr double kGap_m = 1.4;
  const Vector2 border(4.0, 4.0);
  const Vector2 corner(kSide_m, kSide_m);
  const std::vector<Vector2> starts = {{0.0, 0.0}, {2.0, 0.0}, {0.0, 2.0}, {4.0, 0.0}, {0.0, 4.0}};
  Draw draw(1000 + seed);
  std::vector<Vector2> goals;
  for (std::size_t i = 0; i < starts.size(); ++i)
    apart_from(goals, 1.5, corner - Vector2(5.0, 5.0), corner, draw);
  std::vector<Vector2> free = starts;
  free.insert(free.end(), goals.begin(), goals.end());
  FleetWorld world;
  world.circles = strewn(24, 0.4, 1.0, kGap_m, free, Vector2::Zero(), corner, draw);
  const auto map = map_of(world.circles, -border, corner + border);
  for (std::size_t i = 0; i < starts.size(); ++i)
    world.scene.agents.push_back({facing(starts[i], goals[i]), goals[i], map});
  world.scene.seed = seed;
  world.scene.longest_s = 90.0;
  return world;
}

FleetWorld crossing_robots(int seed) {
  constexpr double kRadius_m = 3.0;
  constexpr double kGap_m = 1.5;
  constexpr double kAside_rad = 0.7;
  Draw draw(2000 + seed);
  const int count = 2 + seed % 3;
  std::vector<Vector2> taken;  // no two robots start or end at one place
  FleetWorld world;
  for (int attempt = 0; attempt < kAttempts && static_cast<int>(taken.size()) < 2 * count;
       ++attempt) {
    const double angle_rad = draw.between(-M_PI, M_PI);
    const double opposite_rad = angle_rad + M_PI + draw.between(-kAside_rad, kAside_rad);
    const Vector2 start = kRadius_m * direction(angle_rad);
    const Vector2 goal = kRadius_m * direction(opposite_rad);
    if (attempt % 1000 == 999) {  // these leave no room for the others
      taken.clear();
      world.scene.agents.clear();
    }
    if (std::min(nearest_m(start, taken), nearest_m(goal, taken)) < kGap_m) continue;
    world.scene.agents.push_back({facing(start, goal), goal, nullptr});
    taken.insert(taken.end(), {start, goal});
  }
  const Vector2 middle(1.5, 1.5);
  world.circles = strewn(seed % 5 % 3, 0.2, 0.4, kGap_m, taken, -middle, middle, draw);
  const Vector2 corner(8.0, 8.0);
  const auto map = map_of(world.circles, -corner, corner);
  for (FleetAgent& agent : world.scene.agents) agent.map = map;
  world.scene.seed = seed;
  world.scene.longest_s = 90.0;
  return world;
}

OccupancyGrid map_of(const World& world) {
  OccupancyGrid grid = free_map(world.bounds.min(), world.bounds.max());
  for (const Circle& circle : world.circles)
    fill_disc(grid, circle.centre, circle.radius_m, OccupancyGrid::kOccupied);
  for (const Polygon& polygon : world.polygons)
    fill_polygon(grid, polygon, OccupancyGrid::kOccupied);
  return grid;
}

FleetScene fleet_of(const World& world, int seed) {
  const auto map = std::make_shared<const FleetMap>(map_of(world));
  FleetScene scene;
  for (const WorldRobot& robot : world.robots) {
    if (robot.goal) scene.agents.push_back({robot.start, robot.goal->position, map});
  }
  scene.seed = seed;
  return scene;
}

FleetWorld spread_robots(int count, int seed) {
  constexpr double kRoom_m2 = 40.0;
  constexpr double kDrive_m = 8.0;
  constexpr double kGap_m = 1.4;
  constexpr double kKnown_m = 4.0;  // around the own way
  const double side_m = std::max(std::sqrt(kRoom_m2 * count), 1.5 * kDrive_m);
  const Vector2 high(side_m, side_m);
  Draw draw(3000 + seed);
  std::vector<Vector2> taken;
  std::vector<Vector2> starts;
  for (int i = 0; i < count; ++i)
    starts.push_back(apart_from(taken, 2.0, Vector2::Zero(), high, draw));
  std::vector<Vector2> goals;
  while (static_cast<int>(goals.size()) < count) {
    const Vector2 goal = starts[goals.size()] + kDrive_m * direction(draw.between(-M_PI, M_PI));
    const bool inside = goal.minCoeff() >= 0.0 && (high - goal).minCoeff() >= 0.0;
    if (!inside || nearest_m(goal, taken) < 1.5) continue;
    taken.push_back(goal);
    goals.push_back(goal);
  }
  FleetWorld world;
  world.circles = strewn(count, 0.2, 0.5, kGap_m, taken, Vector2::Zero(), high, draw);
  const Vector2 known(kKnown_m, kKnown_m);
  for (int i = 0; i < count; ++i) {
    const Vector2 low = starts[i].cwiseMin(goals[i]) - known;
    const auto map = map_of(world.circles, low, starts[i].cwiseMax(goals[i]) + known);
    world.scene.agents.push_back({facing(starts[i], goals[i]), goals[i], map});
  }
  world.scene.seed = seed;
  return world;
}

}  // namespace mocha
