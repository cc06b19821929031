#pragma once

#include <memory>
#include <vector>

#include "topology/roadmaps/obstacle_tile.h"
#include "topology/roadmaps/skeleton_tile.h"
#include "topology/static_map/travel_options.h"

namespace mocha {

/// What was made of a map for one robot, tile by tile. Copies share the tiles.
class SkeletonTiles {
 public:
  struct Tile {
    SkeletonTile skeleton;
    ObstacleTile obstacles;
  };

  /// None made yet, of a map with so many corners.
  SkeletonTiles(const TravelOptions& options, int columns, int rows);

  /// Of the corners given, distances have changed: the tiles that have them are to be made anew.
  void forget(const CornerWindow& changed);

  const TravelOptions& options() const { return options_; }
  int columns() const { return columns_; }  ///< of the map's corners
  int rows() const { return rows_; }

  int size() const { return static_cast<int>(tiles_.size()); }
  CornerWindow window(int tile) const;
  /// Those that share a corner with a window.
  std::vector<int> at(const CornerWindow& window) const;

  bool has(int tile) const { return tiles_[tile] != nullptr; }
  const Tile& operator[](int tile) const { return *tiles_[tile]; }
  void set(int tile, Tile made) { tiles_[tile] = std::make_shared<Tile>(std::move(made)); }

 private:
  TravelOptions options_;
  int columns_;
  int rows_;
  int tile_columns_;
  std::vector<std::shared_ptr<const Tile>> tiles_;  // row by row
};

}  // namespace mocha
