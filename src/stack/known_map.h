#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "topology/static_map/grid_static_map.h"
#include "world/distance_field.h"
#include "world/occupancy_grid.h"

namespace mocha {

/// The newest map of a robot and all that is derived from it. Owned here and shared by the
/// planners: made when it is asked for, kept while it serves, and where a new map differs in some
/// places only, repaired there.
class KnownMap {
 public:
  using Solid = DistanceField::Solid;

  /// Whether anything changed. Throws std::invalid_argument for a grid without cells, whose
  /// sizes do not match, or whose origin is not finite.
  bool take(OccupancyGrid grid);

  bool available() const { return newest_.width > 0; }

  /// Distances on the newest map, grown to hold the points with a border. Points so far away that
  /// this would take tens of millions of cells are left out.
  std::shared_ptr<const DistanceField> field(Solid solid, const std::vector<Vector2>& points,
                                             double border_m);
  /// The same map as searches for paths see it.
  std::shared_ptr<const StaticMap> static_map(const std::vector<Vector2>& points, double border_m);

 private:
  std::shared_ptr<DistanceField>& field_of(Solid solid);
  void hold(const std::vector<Vector2>& points, double border_m);
  bool holds(const Vector2& point) const;
  bool within_reach(const Vector2& point, double border_m) const;
  /// Where the first cell of a map lies on the one that is held, if that holds all of it, cell on
  /// cell, and nothing more that was known.
  std::optional<Eigen::Vector2i> place_of(const OccupancyGrid& grid) const;
  void forget();
  void repair(const OccupancyGrid& grid, const Eigen::Vector2i& place);

  OccupancyGrid newest_;  // as it came
  OccupancyGrid held_;    // grown; without cells where nothing is derived
  std::shared_ptr<DistanceField> occupied_;
  std::shared_ptr<DistanceField> unseen_;
  std::shared_ptr<const GridStaticMap> static_map_;
};

}  // namespace mocha
