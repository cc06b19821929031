#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "perception/mapping/beam_raster.h"
#include "perception/mapping/column_grid.h"
#include "perception/mapping/occupancy_map_options.h"
#include "perception/mapping/octree_file.h"
#include "world/occupancy_grid.h"

namespace mocha {

/// The index of the voxel at a height, or of the cell at a coordinate.
inline int layer_of(double height_m, double resolution_m) {
  return static_cast<int>(std::floor(height_m / resolution_m));
}

/// The voxels of the height band, and how measurements change them.
struct VoxelBand {
  explicit VoxelBand(const OccupancyMapOptions& options);

  /// More of the same changes nothing: the log-odds are at their limit.
  bool is_surely_free(float log_odds) const { return log_odds <= lowest; }
  bool is_surely_occupied(float log_odds) const { return log_odds >= highest; }

  void update(const VoxelIndex& voxel, bool is_hit);
  /// Nothing occupied is left in a column.
  void clear_column(int x, int y);
  /// One measurement: each voxel counts once. Throws MapError (and changes nothing) if the map
  /// cannot grow so far.
  void insert(const std::vector<GridBeam>& beams);

  /// Voxels of a file that was parsed enter. What it knows beyond the band is kept for written().
  void read_tree(OctreeFile file);
  /// A planar map enters at the scans' height.
  void read_grid(const OccupancyGrid& grid);
  /// As an OctoMap file, .bt or .ot.
  std::string written(bool binary) const;

  double resolution_m;
  float hit, miss, lowest, highest;  // log-odds
  ColumnGrid columns;
  int scan_layer;
  std::optional<OctreeFile> beyond;  // was loaded, and holds more than the height band
  BeamRaster raster;
};

}  // namespace mocha
