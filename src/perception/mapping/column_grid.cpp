#include "perception/mapping/column_grid.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "perception/mapping/map_error.h"

namespace mocha {
namespace {

constexpr int kBlock = 128;  // the grid grows by multiples of this many cells
constexpr double kMostCells = 64e6;
constexpr int kFarthest = 32000;  // of the octree's 2^15 cells on each side of the origin

int block_floor(int i) {
  return static_cast<int>(std::floor(static_cast<double>(i) / kBlock)) * kBlock;
}
int block_ceil(int i) { return block_floor(i) + kBlock; }

template <class T>
void relocate(std::vector<T>& cells, T fill, int from_width, int from_height, std::ptrdiff_t first,
              int to_width, int to_height) {
  std::vector<T> moved(static_cast<std::size_t>(to_width) * to_height, fill);
  for (int y = 0; y < from_height; ++y) {
    const auto row = cells.begin() + static_cast<std::ptrdiff_t>(y) * from_width;
    std::copy(row, row + from_width,
              moved.begin() + first + static_cast<std::ptrdiff_t>(y) * to_width);
  }
  cells.swap(moved);
}

}  // namespace

ColumnGrid::ColumnGrid(double resolution_m, int first_layer, int last_layer)
    : resolution_m_(resolution_m),
      first_layer_(first_layer),
      layers_(static_cast<std::size_t>(last_layer - first_layer + 1)) {}

void ColumnGrid::reserve(const VoxelIndex& low, const VoxelIndex& high) {
  if (contains(low[0], low[1]) && contains(high[0], high[1])) return;
  for (int i : {low[0], low[1], high[0], high[1]}) {
    if (i < -kFarthest || i > kFarthest) {
      throw MapError("a map with cells of " + std::to_string(resolution_m_) +
                     " m cannot hold anything " + std::to_string(i * resolution_m_) +
                     " m from its origin");
    }
  }
  const bool empty = width_ == 0;
  const int x0 = empty ? block_floor(low[0]) : std::min(block_floor(low[0]), x0_);
  const int y0 = empty ? block_floor(low[1]) : std::min(block_floor(low[1]), y0_);
  const int x1 = empty ? block_ceil(high[0]) : std::max(block_ceil(high[0]), x0_ + width_);
  const int y1 = empty ? block_ceil(high[1]) : std::max(block_ceil(high[1]), y0_ + height_);
  if (static_cast<double>(x1 - x0) * (y1 - y0) > kMostCells) {
    throw MapError("the map would grow to " + std::to_string((x1 - x0) * resolution_m_) + " m x " +
                   std::to_string((y1 - y0) * resolution_m_) + " m, too many cells of " +
                   std::to_string(resolution_m_) + " m");
  }
  const std::ptrdiff_t first =
      empty ? 0 : (y0_ - y0) * static_cast<std::ptrdiff_t>(x1 - x0) + (x0_ - x0);
  for (auto& layer : layers_) {
    if (!layer.empty()) {
      relocate(layer, VoxelState::kUnknown, width_, height_, first, x1 - x0, y1 - y0);
    }
  }
  relocate(occupied_, std::uint16_t{0}, width_, height_, first, x1 - x0, y1 - y0);
  relocate(slice_, OccupancyGrid::kUnknown, width_, height_, first, x1 - x0, y1 - y0);
  x0_ = x0;
  y0_ = y0;
  width_ = x1 - x0;
  height_ = y1 - y0;
}

VoxelState ColumnGrid::at(const VoxelIndex& voxel) const {
  const auto& layer = layers_[voxel[2] - first_layer_];
  if (layer.empty() || !contains(voxel[0], voxel[1])) return VoxelState::kUnknown;
  return layer[index(voxel[0], voxel[1])];
}

void ColumnGrid::set(const VoxelIndex& voxel, VoxelState state) {
  auto& layer = layers_[voxel[2] - first_layer_];
  if (layer.empty()) layer.assign(slice_.size(), VoxelState::kUnknown);
  const std::size_t i = index(voxel[0], voxel[1]);
  occupied_[i] = static_cast<std::uint16_t>(occupied_[i] + (is_occupied(state) ? 1 : 0) -
                                            (is_occupied(layer[i]) ? 1 : 0));
  layer[i] = state;
  const std::int8_t value = occupied_[i] > 0 ? OccupancyGrid::kOccupied : OccupancyGrid::kFree;
  if (value == slice_[i]) return;
  if (slice_[i] == OccupancyGrid::kUnknown) note_known(voxel[0], voxel[1]);
  slice_[i] = value;
  ++version_;
}

void ColumnGrid::note_known(int x, int y) {
  if (!any_known_) {
    known_low_ = known_high_ = {x, y};
    any_known_ = true;
    return;
  }
  known_low_ = {std::min(known_low_[0], x), std::min(known_low_[1], y)};
  known_high_ = {std::max(known_high_[0], x), std::max(known_high_[1], y)};
}

bool ColumnGrid::is_unknown(int x, int y) const {
  return !contains(x, y) || slice_[index(x, y)] == OccupancyGrid::kUnknown;
}

OccupancyGrid ColumnGrid::slice(int border_cells) const {
  const std::array<int, 2> size = any_known_
                                      ? std::array<int, 2>{known_high_[0] - known_low_[0] + 1,
                                                           known_high_[1] - known_low_[1] + 1}
                                      : std::array<int, 2>{0, 0};
  OccupancyGrid grid;
  grid.resolution_m = resolution_m_;
  grid.origin = resolution_m_ * Vector2(known_low_[0] - border_cells, known_low_[1] - border_cells);
  grid.width = size[0] + 2 * border_cells;
  grid.height = size[1] + 2 * border_cells;
  grid.cells.assign(static_cast<std::size_t>(grid.width) * grid.height, OccupancyGrid::kUnknown);
  for (int y = 0; y < size[1]; ++y) {
    const auto row =
        slice_.begin() + static_cast<std::ptrdiff_t>(index(known_low_[0], known_low_[1] + y));
    std::copy(row, row + size[0], &grid.at(border_cells, border_cells + y));
  }
  return grid;
}

std::vector<VoxelIndex> ColumnGrid::occupied() const {
  std::vector<VoxelIndex> voxels;
  for (std::size_t k = 0; k < layers_.size(); ++k) {
    for (std::size_t i = 0; i < layers_[k].size(); ++i) {
      if (!is_occupied(layers_[k][i])) continue;
      voxels.push_back({x0_ + static_cast<int>(i % width_), y0_ + static_cast<int>(i / width_),
                        first_layer_ + static_cast<int>(k)});
    }
  }
  return voxels;
}

}  // namespace mocha
