#include "topology/roadmaps/skeleton_tiles.h"

#include <algorithm>

namespace mocha {
namespace {

constexpr int kTile = 64;  // cells along a side

int tiles_along(int corners) { return std::max(1, (corners - 2) / kTile + 1); }

}  // namespace

SkeletonTiles::SkeletonTiles(const TravelOptions& options, int columns, int rows)
    : options_(options),
      columns_(columns),
      rows_(rows),
      tile_columns_(tiles_along(columns)),
      tiles_(static_cast<std::size_t>(tile_columns_) * tiles_along(rows)) {}

CornerWindow SkeletonTiles::window(int tile) const {
  const int x0 = tile % tile_columns_ * kTile;
  const int y0 = tile / tile_columns_ * kTile;
  return {x0, y0, std::min(x0 + kTile, columns_ - 1), std::min(y0 + kTile, rows_ - 1)};
}

std::vector<int> SkeletonTiles::at(const CornerWindow& window) const {
  const int tile_rows = size() / tile_columns_;
  const int x0 = std::max(0, (window.x0 - 1) / kTile);
  const int y0 = std::max(0, (window.y0 - 1) / kTile);
  std::vector<int> tiles;
  for (int y = y0; y <= std::min(window.y1 / kTile, tile_rows - 1); ++y) {
    for (int x = x0; x <= std::min(window.x1 / kTile, tile_columns_ - 1); ++x)
      tiles.push_back(y * tile_columns_ + x);
  }
  return tiles;
}

void SkeletonTiles::forget(const CornerWindow& changed) {
  if (changed.empty()) return;
  for (const int tile : at(changed)) tiles_[tile].reset();
}

}  // namespace mocha
