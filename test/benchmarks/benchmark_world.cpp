#include "benchmarks/benchmark_world.h"

#include <cmath>
#include <stdexcept>

#include "topology/paths/class_search.h"
#include "topology/paths/euclidean_shortcutting.h"
#include "topology/paths/grid_path.h"
#include "topology/paths/path_shortcutting.h"
#include "topology/paths/taut_path.h"
#include "topology/roadmaps/visibility_prm.h"
#include "topology/shipped_options.h"
#include "topology/static_map/grid_static_map.h"

namespace mocha {
namespace {

constexpr double kCell_m = 0.25;
constexpr double kBorder_m = 6.0;
constexpr double kLattice_m = 0.5;

std::vector<Vector2> front_end(const std::vector<Circle>& circles, double side_m,
                               double clearance_m) {
  OccupancyGrid map;
  map.resolution_m = kCell_m;
  map.origin = {-kBorder_m, -kBorder_m};
  map.width = map.height = static_cast<int>((side_m + 2.0 * kBorder_m) / kCell_m);
  map.cells.assign(static_cast<std::size_t>(map.width) * map.height, OccupancyGrid::kFree);
  for (const Circle& circle : circles) {
    fill_disc(map, circle.centre, circle.radius_m, OccupancyGrid::kOccupied);
  }
  TravelOptions options = shipped_travel_options();
  options.required_clearance_m = clearance_m;
  options.preferred_clearance_m = clearance_m;
  const GridStaticMap static_map(
      std::make_shared<DistanceField>(map, DistanceField::Solid::kOccupied));
  const Vector2 start(0.0, 0.0);
  const Vector2 goal(side_m, side_m);
  const TravelCost cost(static_map, start, {}, options);
  const GridPath path = find_grid_path(static_map, start, goal, cost, kLattice_m);
  if (path.outcome != GridPath::Outcome::kFound) {
    throw std::runtime_error("benchmark world: there is no path through");
  }
  return with_shortcuts(path.points, cost, Cuts<2>({}));
}

/// Start and goal.
std::vector<Vector2> corners(const Ground& ground) {
  return {{0.0, 0.0}, {ground.side_m, ground.side_m}};
}

}  // namespace

std::vector<Circle> scatter(const Ground& ground, double gap_m, const std::vector<Vector2>& free,
                            std::mt19937& random) {
  std::uniform_real_distribution<double> place(0.0, ground.side_m);
  std::uniform_real_distribution<double> size(ground.smallest_m, ground.largest_m);
  std::vector<Circle> circles;
  for (int attempt = 0; attempt < 200000; ++attempt) {
    const Circle circle{{place(random), place(random)}, size(random)};
    const auto is_apart = [&](const Vector2& p, double radius) {
      return (p - circle.centre).norm() > radius + circle.radius_m + gap_m;
    };
    bool apart = true;
    for (const Vector2& point : free) apart = apart && is_apart(point, 0.0);
    for (const Circle& other : circles) apart = apart && is_apart(other.centre, other.radius_m);
    if (apart) circles.push_back(circle);
    if (static_cast<int>(circles.size()) == ground.circles) return circles;
  }
  throw std::runtime_error("benchmark world: the circles do not fit");
}

BenchmarkWorld<2> circle_world(int seed, const BenchmarkOptions& options) {
  std::mt19937 random(seed);
  const Ground& ground = options.ground;
  const std::vector<Circle> circles = scatter(ground, options.gap_m, corners(ground), random);
  return {std::make_shared<PrimitiveField<2>>(std::vector<Obstacle>(circles.begin(), circles.end()),
                                              2.0),
          front_end(circles, ground.side_m, options.front_end_clearance_m)};
}

BenchmarkWorld<3> forest_world(int seed, const BenchmarkOptions& options) {
  constexpr double kStartHeight_m = 2.0;
  constexpr double kClimb_m = 8.0;
  constexpr double kCanopy_m = 12.0;
  const VisibilityPrmOptions roadmap{6000, 1, 25.0};
  std::mt19937 random(1000 + seed);
  const Ground& ground = options.ground;
  const std::vector<Circle> circles = scatter(ground, options.gap_m, corners(ground), random);
  std::vector<Cylinder> trunks;
  std::vector<Cuts<3>::Curve> columns(circles.size());
  for (std::size_t i = 0; i < circles.size(); ++i) {
    trunks.push_back({circles[i].centre, circles[i].radius_m});
    columns[i] = Column{circles[i].centre};
  }
  BenchmarkWorld<3> world{std::make_shared<PrimitiveField<3>>(std::move(trunks), 2.0), {}};
  const Eigen::Vector3d start(0.0, 0.0, kStartHeight_m);
  const Eigen::Vector3d goal(ground.side_m, ground.side_m, kStartHeight_m + kClimb_m);
  const Cuts<3> cuts(columns);
  const StaticSpace<3> space(
      *world.field, cuts,
      {Eigen::Vector3d(-kBorder_m, -kBorder_m, 0.0),
       Eigen::Vector3d(ground.side_m + kBorder_m, ground.side_m + kBorder_m, kCanopy_m)},
      start, {options.front_end_clearance_m, 0.0});
  const auto paths =
      shortest_classes<3>(visibility_prm<3>(space, start, goal, roadmap), space, {1, 1.0});
  if (paths.empty()) throw std::runtime_error("benchmark world: there is no path through");
  world.path = pulled_taut(with_shortcuts<3>(paths.front().points, space), space);
  return world;
}

}  // namespace mocha
