#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "topology/static_map/grid_static_map.h"
#include "world/distances/distance_field.h"
#include "world/occupancy_grid.h"

namespace mocha {

/// The newest map of a robot and all that is derived from it. Owned here and shared by the
/// planners: made when it is asked for, kept while it serves, and where a new map differs in some
/// places only, repaired there.
///
/// One thread may take maps while another asks for what follows from them: taking only lays them
/// by, and never waits for that.
class KnownMap {
 public:
  using Solid = DistanceField::Solid;

  /// Throws std::invalid_argument for a grid without cells, whose sizes do not match, or whose
  /// origin is not finite.
  void take(OccupancyGrid grid);
  /// Of the newest grid. Throws std::invalid_argument for one that does not fit it.
  void take(GridUpdate update);

  bool available() const;

  /// The newest map as it came.
  OccupancyGrid newest();
  /// Distances on the newest map, grown to hold the points with a border. Points so far away that
  /// this would take tens of millions of cells are left out.
  std::shared_ptr<const DistanceField> field(Solid solid, const std::vector<Vector2>& points,
                                             double border_m);
  /// The same map as searches for paths see it.
  std::shared_ptr<const StaticMap> static_map(const std::vector<Vector2>& points, double border_m);

 private:
  /// What has come in since the map was last asked for.
  struct Pending {
    std::optional<OccupancyGrid> grid;
    std::vector<GridUpdate> updates;  // since, in their order
  };

  void digest();
  void change_to(OccupancyGrid grid);
  void update_by(const std::vector<GridUpdate>& updates);
  std::shared_ptr<DistanceField>& field_of(Solid solid);
  void hold(const std::vector<Vector2>& points, double border_m);
  bool holds(const Vector2& point) const;
  bool within_reach(const Vector2& point, double border_m) const;
  /// Where the first cell of a map lies on the one that is held, if that holds all of it, cell on
  /// cell, and nothing more that was known.
  std::optional<Eigen::Vector2i> place_of(const OccupancyGrid& grid) const;
  void forget();
  void repair(const OccupancyGrid& part, const Eigen::Vector2i& place);

  mutable std::mutex pending_mutex_;  // of the next three
  Pending pending_;
  int width_ = 0;  // of the newest grid, digested or not
  int height_ = 0;

  std::mutex mutex_;  // of all below
  OccupancyGrid held_;
  bool is_grown_ = false;             // to hold the points that were asked for
  CornerWindow known_{0, 0, -1, -1};  // cells of the newest grid in what is held
  std::shared_ptr<DistanceField> occupied_;
  std::shared_ptr<DistanceField> unseen_;
  std::shared_ptr<const GridStaticMap> static_map_;
};

}  // namespace mocha
