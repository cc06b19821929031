#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "perception/mapping/map_error.h"
#include "perception/mapping/occupancy_map_options.h"
#include "perception/sensor/beam.h"
#include "perception/sensor/blind_wall.h"
#include "world/corner_window.h"
#include "world/occupancy_grid.h"
#include "world/start_ground.h"

namespace mocha {

struct VoxelBand;

/// What the sensors have seen of the robot's height band, as OctoMap counts it, and the planar
/// slice of that.
class OccupancyMap {
 public:
  /// Throws std::invalid_argument, naming the value and its range.
  explicit OccupancyMap(const OccupancyMapOptions& options);
  ~OccupancyMap();
  OccupancyMap(const OccupancyMap&) = delete;
  OccupancyMap& operator=(const OccupancyMap&) = delete;

  /// As given, but for the size of the cells: that is the loaded map's, if one of smaller cells was
  /// loaded.
  const OccupancyMapOptions& options() const { return options_; }

  /// One planar scan; heights of the beams do not matter. Voxels that any beam hit are hit, others
  /// that beams passed are free. Beams with coordinates that are not finite are left out. Throws
  /// MapError (and changes nothing) if the map cannot grow so far.
  void insert_scan(const std::vector<Beam>& beams);

  /// One cloud of 3-D measurements. Only what lies in the height band enters the map; beams that
  /// end below or above still clear where they cross the band. Otherwise as insert_scan().
  void insert_points(const std::vector<Beam>& beams);

  /// The robot is here [map frame]. It has started here if nothing is known of the cell of its
  /// base: cells with centres on the start's ground then become free if nothing is known of them,
  /// but for what `walls` hide. Throws MapError (and changes nothing) if the map cannot grow so
  /// far.
  void see_robot(const Pose& base, const StartGround& ground, const std::vector<BlindWall>& walls);

  /// The body is here [map frame], so nothing else is: occupied cells with centres under it become
  /// free. What is beside it may be seen too near by a cell and the lidar's noise.
  void clear_body(const Pose& base, const Footprint& footprint);

  /// Something that is not part of the map stands here: occupied cells with centres within the disc
  /// become free. A disc that is nowhere near the map changes nothing.
  void clear_disc(const Vector2& centre, double radius_m);

  /// Whether so many planar scans have passed the point's cell that one more changes nothing. The
  /// point must be usable, see is_usable().
  bool is_surely_free(const Vector2& point) const;

  /// Whether a cell of the planar scans with its centre within the disc is occupied; `surely`: was
  /// hit so often that one more hit changes nothing. The centre must be usable, see is_usable().
  bool is_occupied_within(const Vector2& centre, double radius_m, bool surely) const;

  /// Whether nothing is known of any cell of the planar scans with its centre within the disc. The
  /// centre must be usable, see is_usable().
  bool is_unknown_within(const Vector2& centre, double radius_m) const;

  /// The planar slice: occupied if any voxel of the height band is, free if none is and any is
  /// free. Its known part, with a border of unknown cells [m] around it.
  OccupancyGrid slice(double border_m) const;

  /// Changes whenever a cell of the slice does.
  std::uint64_t version() const;

  // For a copy of the slice that is kept up to date. Cells have the indices of their lower corners
  // in cells from the map's origin; windows of them include both ends.

  /// Around all that is known; empty where nothing is.
  const CornerWindow& known_cells() const;
  /// What holds all cells of the slice that have changed since this was asked last.
  std::vector<CornerWindow> take_changes();
  /// How often the map was loaded or cleared: then everything has changed.
  int replaced() const { return replaced_; }
  /// Cells of the slice into a grid whose lower left cell has the index `origin`.
  void copy_slice(const CornerWindow& cells, const Eigen::Vector2i& origin,
                  OccupancyGrid& grid) const;

  /// Centres of the occupied voxels of the height band, map frame [m].
  std::vector<Eigen::Vector3f> occupied_voxels() const;

  /// By the path's ending: .bt and .ot (OctoMap), .yaml (map_server: the slice, with a .pgm beside
  /// it). Throws MapError.
  void save(const std::string& path);

  /// Replaces the map by a saved one and goes on with cells of its size, see options(); one of
  /// larger cells than this map was made for is resampled to those, and what an octree knows beyond
  /// the height band is forgotten then. A planar map enters at the scans' height; its origin is
  /// moved to the nearest multiple of its cells. Returns in words what was not taken as it is.
  /// Throws MapError, leaving the map as it was, if the file is damaged or the size of its cells
  /// out of range.
  std::string load(const std::string& path);

  /// Becomes what the other one is, which may be used no more; made with the same options.
  void take(OccupancyMap& other);

  /// Forgets everything but the size of the cells.
  void clear();

 private:
  void replace(std::unique_ptr<VoxelBand> voxels);

  const double largest_cell_m_;
  OccupancyMapOptions options_;
  std::unique_ptr<VoxelBand> voxels_;
  std::uint64_t version_before_ = 0;  // of the maps that voxels_ replaced
  int replaced_ = 0;
};

}  // namespace mocha
