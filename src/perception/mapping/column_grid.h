#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "perception/mapping/beam_raster.h"
#include "perception/mapping/cell_blocks.h"
#include "perception/mapping/changed_cells.h"
#include "world/corner_window.h"
#include "world/occupancy_grid.h"

namespace mocha {

/// Log-odds of the voxels of the robot's height band, and the planar slice that follows from them:
/// a cell is occupied if any voxel of its column is, free if none is and any is known. An octree
/// would take ten times the memory: it joins equal voxels by eights only, and a scan knows one
/// layer.
class ColumnGrid {
 public:
  /// Of a voxel of which nothing is known: no number.
  static constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  static bool is_occupied(float log_odds) { return log_odds >= 0.0f; }

  /// Layers with vertical indices first_layer to last_layer.
  ColumnGrid(double resolution_m, int first_layer, int last_layer);

  /// Before voxels of a box are set. Throws MapError if the map would become too large.
  void reserve(const VoxelIndex& low, const VoxelIndex& high);

  /// kUnknown wherever nothing was set.
  float log_odds(const VoxelIndex& voxel) const {
    return layers_[voxel[2] - first_layer_].at(voxel[0], voxel[1]);
  }
  void set(const VoxelIndex& voxel, float log_odds);

  int first_layer() const { return first_layer_; }
  int last_layer() const { return first_layer_ + static_cast<int>(layers_.size()) - 1; }
  bool is_unknown(int x, int y) const { return slice_.at(x, y) == OccupancyGrid::kUnknown; }

  /// Changes whenever a cell of the slice does.
  std::uint64_t version() const { return version_; }
  /// Rectangles that hold all cells of the slice that have changed since this was asked last.
  std::vector<CornerWindow> take_changes() { return changes_.take(); }

  /// The cells around all that is known; empty where nothing is.
  const CornerWindow& known() const { return known_; }
  /// Copies the slice into a grid of which `origin` is the cell with the lowest indices.
  void copy(const CornerWindow& cells, const Eigen::Vector2i& origin, OccupancyGrid& grid) const;
  /// The known part of the slice with a border of unknown cells around it.
  OccupancyGrid slice(int border_cells) const;

  std::vector<VoxelIndex> occupied() const;

  /// Calls visit(index, log_odds) for all voxels that are known.
  template <class Visit>
  void for_each_known(Visit visit) const {
    for (std::size_t k = 0; k < layers_.size(); ++k) {
      layers_[k].for_each([&](int x, int y, float log_odds) {
        if (!std::isnan(log_odds)) visit({x, y, first_layer_ + static_cast<int>(k)}, log_odds);
      });
    }
  }

 private:
  bool is_column_occupied(int x, int y) const;

  double resolution_m_;
  int first_layer_;
  CornerWindow room_{0, 0, -1, -1};  // what was reserved
  std::vector<CellBlocks<float>> layers_;
  CellBlocks<std::int8_t> slice_{OccupancyGrid::kUnknown};
  CornerWindow known_{0, 0, -1, -1};
  ChangedCells changes_;
  std::uint64_t version_ = 0;
};

}  // namespace mocha
