#include "perception/mapping/column_grid.h"

#include <algorithm>
#include <string>

#include "perception/mapping/map_error.h"

namespace mocha {
namespace {

constexpr double kMostCells = 64e6;
constexpr int kFarthest = 32000;  // of the octree's 2^15 cells on each side of the origin

}  // namespace

ColumnGrid::ColumnGrid(double resolution_m, int first_layer, int last_layer)
    : resolution_m_(resolution_m), first_layer_(first_layer) {
  for (int k = first_layer; k <= last_layer; ++k) layers_.emplace_back(kUnknown);
}

void ColumnGrid::reserve(const VoxelIndex& low, const VoxelIndex& high) {
  if (room_.holds(low[0], low[1]) && room_.holds(high[0], high[1])) return;
  for (int i : {low[0], low[1], high[0], high[1]}) {
    if (i < -kFarthest || i > kFarthest) {
      throw MapError("a map with cells of " + std::to_string(resolution_m_) +
                     " m cannot hold anything " + std::to_string(i * resolution_m_) +
                     " m from its origin");
    }
  }
  const CornerWindow room = room_.united({low[0], low[1], high[0], high[1]});
  if (static_cast<double>(room.columns()) * room.rows() > kMostCells) {
    throw MapError("the map would grow to " + std::to_string(room.columns() * resolution_m_) +
                   " m x " + std::to_string(room.rows() * resolution_m_) +
                   " m, too many cells of " + std::to_string(resolution_m_) + " m");
  }
  room_ = room;
}

void ColumnGrid::set(const VoxelIndex& voxel, float log_odds) {
  const auto [x, y, z] = voxel;
  float& known = layers_[z - first_layer_].ref(x, y);
  const bool was_occupied = is_occupied(known);
  const bool was_unknown = std::isnan(known);
  known = log_odds;
  if (is_occupied(log_odds) == was_occupied && !was_unknown) return;
  const std::int8_t value =
      is_column_occupied(x, y) ? OccupancyGrid::kOccupied : OccupancyGrid::kFree;
  std::int8_t& cell = slice_.ref(x, y);
  if (value == cell) return;
  cell = value;
  known_ = known_.united({x, y, x, y});
  changes_.add(x, y);
  ++version_;
}

bool ColumnGrid::is_column_occupied(int x, int y) const {
  return std::any_of(layers_.begin(), layers_.end(),
                     [&](const CellBlocks<float>& layer) { return is_occupied(layer.at(x, y)); });
}

void ColumnGrid::copy(const CornerWindow& cells, const Eigen::Vector2i& origin,
                      OccupancyGrid& grid) const {
  for (int y = cells.y0; y <= cells.y1; ++y)
    slice_.copy_row(cells.x0, y, cells.columns(), &grid.at(cells.x0 - origin.x(), y - origin.y()));
}

OccupancyGrid ColumnGrid::slice(int border_cells) const {
  const CornerWindow whole = known_.grown(border_cells);
  OccupancyGrid grid;
  grid.resolution_m = resolution_m_;
  grid.origin = resolution_m_ * Vector2(whole.x0, whole.y0);
  grid.width = whole.columns();
  grid.height = whole.rows();
  grid.cells.resize(static_cast<std::size_t>(grid.width) * grid.height);
  if (!whole.empty()) copy(whole, {whole.x0, whole.y0}, grid);
  return grid;
}

std::vector<VoxelIndex> ColumnGrid::occupied() const {
  std::vector<VoxelIndex> voxels;
  for_each_known([&](const VoxelIndex& voxel, float log_odds) {
    if (is_occupied(log_odds)) voxels.push_back(voxel);
  });
  return voxels;
}

}  // namespace mocha
