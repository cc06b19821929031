#pragma once

#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "topology/paths/grid_path.h"
#include "topology/paths/path_shortcutting.h"
#include "topology/static_map/grid_static_map.h"
#include "world/distances/distance_field.h"
#include "world/occupancy_grid.h"

namespace mocha {

/// A map to be drawn on: all free at first.
inline OccupancyGrid free_grid(const Vector2& low, const Vector2& high,
                               double resolution_m = 0.05) {
  OccupancyGrid grid;
  grid.resolution_m = resolution_m;
  grid.origin = low;
  grid.width = static_cast<int>(std::lround((high.x() - low.x()) / resolution_m));
  grid.height = static_cast<int>(std::lround((high.y() - low.y()) / resolution_m));
  grid.cells.assign(static_cast<std::size_t>(grid.width) * grid.height, OccupancyGrid::kFree);
  return grid;
}

/// Sets all cells whose centre is inside the rectangle.
inline void fill_box(OccupancyGrid& grid, const Vector2& low, const Vector2& high,
                     int8_t value = OccupancyGrid::kOccupied) {
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const Vector2 centre = grid.cell_centre(x, y);
      if ((centre - low).minCoeff() >= 0.0 && (high - centre).minCoeff() >= 0.0)
        grid.at(x, y) = value;
    }
  }
}

inline std::shared_ptr<const DistanceField> occupied_field(const OccupancyGrid& grid) {
  return std::make_shared<DistanceField>(grid, DistanceField::Solid::kOccupied);
}

inline std::shared_ptr<const DistanceField> unseen_field(const OccupancyGrid& grid) {
  return std::make_shared<DistanceField>(grid, DistanceField::Solid::kOccupiedOrUnknown);
}

inline std::shared_ptr<const StaticMap> static_map_of(std::shared_ptr<const DistanceField> field) {
  return std::make_shared<GridStaticMap>(std::move(field));
}

inline std::shared_ptr<const StaticMap> static_map_of(const OccupancyGrid& grid) {
  return static_map_of(occupied_field(grid));
}

/// The lattice path with its corners cut, and what it costs.
struct FoundGridPath : GridPath {
  double cost = 0.0;
};

inline FoundGridPath find_path_on_grid(std::shared_ptr<const DistanceField> field,
                                       const Vector2& start, const Vector2& goal,
                                       const std::vector<BlockedDisc>& blocked,
                                       const TravelOptions& options, double step_m = 0.05) {
  const GridStaticMap static_map(std::move(field));
  const TravelCost cost(static_map, start, blocked, options);
  FoundGridPath path{find_grid_path(static_map, start, goal, cost, step_m)};
  if (path.outcome != GridPath::Outcome::kFound) return path;
  path.points = with_shortcuts(path.points, cost, Cuts<2>({}));
  path.cost = cost_of(path.points, cost);
  return path;
}

/// 8 x 6 m from the origin on with `count` random discs, none nearer than `free_m` to `start` and
/// `goal`.
inline OccupancyGrid random_world(int seed, int count, const Vector2& start, const Vector2& goal,
                                  double free_m) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> x(0.0, 8.0);
  std::uniform_real_distribution<double> y(0.0, 6.0);
  std::uniform_real_distribution<double> radius(0.1, 0.45);
  OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
  for (int i = 0; i < count; ++i) {
    const Vector2 centre(x(random), y(random));
    const double radius_m = radius(random);
    const double apart_m = std::min((centre - start).norm(), (centre - goal).norm());
    if (apart_m > radius_m + free_m) fill_disc(grid, centre, radius_m, OccupancyGrid::kOccupied);
  }
  return grid;
}

}  // namespace mocha
