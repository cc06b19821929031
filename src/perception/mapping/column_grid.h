#pragma once

#include <cstdint>
#include <vector>

#include "perception/mapping/beam_raster.h"
#include "world/occupancy_grid.h"

namespace mocha {

/// What is known of a voxel; "sure" ones are at the limit of their log-odds and do not change by
/// more of the same.
enum class VoxelState : std::uint8_t { kUnknown, kFree, kFreeSure, kOccupied, kOccupiedSure };

inline bool is_occupied(VoxelState state) { return state >= VoxelState::kOccupied; }

/// A dense copy of the voxels of the robot's height band, and the planar slice that follows from
/// it: a cell is occupied if any voxel of its column is, free if none is and any is free. Grows as
/// needed; a layer costs memory once something is in it.
class ColumnGrid {
 public:
  /// Layers with vertical indices first_layer to last_layer.
  ColumnGrid(double resolution_m, int first_layer, int last_layer);

  /// Makes room. Throws MapError if the map would become too large.
  void reserve(const VoxelIndex& low, const VoxelIndex& high);

  /// Unknown wherever nothing was set.
  VoxelState at(const VoxelIndex& voxel) const;
  /// Of a voxel for whose column there is room.
  void set(const VoxelIndex& voxel, VoxelState state);

  int first_layer() const { return first_layer_; }
  int last_layer() const { return first_layer_ + static_cast<int>(layers_.size()) - 1; }
  bool is_unknown(int x, int y) const;

  /// Changes whenever a cell of the slice does.
  std::uint64_t version() const { return version_; }

  /// The known part of the slice with a border of unknown cells around it.
  OccupancyGrid slice(int border_cells) const;

  std::vector<VoxelIndex> occupied() const;

 private:
  bool contains(int x, int y) const {
    return x >= x0_ && y >= y0_ && x < x0_ + width_ && y < y0_ + height_;
  }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - y0_) * width_ + (x - x0_);
  }
  void note_known(int x, int y);

  double resolution_m_;
  int first_layer_;
  int x0_ = 0;
  int y0_ = 0;
  int width_ = 0;
  int height_ = 0;
  std::vector<std::vector<VoxelState>> layers_;  // empty until used
  std::vector<std::uint16_t> occupied_;          // voxels of each column
  std::vector<std::int8_t> slice_;
  bool any_known_ = false;
  std::array<int, 2> known_low_{};
  std::array<int, 2> known_high_{};
  std::uint64_t version_ = 0;
};

}  // namespace mocha
