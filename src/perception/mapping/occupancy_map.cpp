#include "perception/mapping/occupancy_map.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <utility>

#include "perception/mapping/cell_disc.h"
#include "perception/mapping/grid_beam.h"
#include "perception/mapping/map_image.h"
#include "perception/mapping/octree_file.h"
#include "perception/mapping/resampling.h"
#include "perception/mapping/voxel_band.h"

namespace mocha {
namespace {

constexpr double kSameCell_m = 1e-6;

/// A place of the map in the frame of a body.
Vector2 in_body(const Vector2& place, const Pose& base) {
  return turned(place - base.position, {std::cos(base.yaw_rad), -std::sin(base.yaw_rad)});
}

/// What `read` throws then is a MapError that names the file.
template <class Read>
void name_file(const std::string& path, Read read) {
  try {
    read();
  } catch (const std::exception& error) {
    throw MapError(path + ": " + error.what());
  }
}

}  // namespace

OccupancyMap::OccupancyMap(const OccupancyMapOptions& options)
    : largest_cell_m_(options.resolution_m),
      options_(options.checked()),
      voxels_(std::make_unique<VoxelBand>(options_)) {}

OccupancyMap::~OccupancyMap() = default;

void OccupancyMap::insert_scan(const std::vector<Beam>& beams) {
  std::vector<GridBeam> flat;
  flat.reserve(beams.size());
  const double z = voxels_->scan_layer + 0.5;
  for (const Beam& beam : beams) {
    if (!is_usable(beam)) continue;
    GridBeam cells{beam.origin / options_.resolution_m, beam.end / options_.resolution_m,
                   beam.kind};
    cells.origin.z() = cells.end.z() = z;
    flat.push_back(cells);
  }
  voxels_->insert(flat);
}

void OccupancyMap::insert_points(const std::vector<Beam>& beams) {
  const double low = voxels_->columns.first_layer();
  const double high = std::nextafter(voxels_->columns.last_layer() + 1.0, low);
  std::vector<GridBeam> clipped;
  clipped.reserve(beams.size());
  for (const Beam& beam : beams) {
    if (!is_usable(beam)) continue;
    GridBeam cells{beam.origin / options_.resolution_m, beam.end / options_.resolution_m,
                   beam.kind};
    const bool in_band =
        beam.end.z() >= options_.min_height_m && beam.end.z() <= options_.max_height_m;
    if (cells.kind == BeamEnd::kHit && !in_band) cells.kind = BeamEnd::kIgnored;
    if (clip_height(cells, low, high)) clipped.push_back(cells);
  }
  voxels_->insert(clipped);
}

void OccupancyMap::see_robot(const Pose& base, const StartGround& ground,
                             const std::vector<BlindWall>& walls) {
  if (!is_usable(base.position)) throw MapError("the robot stands nowhere that a map could hold");
  const double cell_m = options_.resolution_m;
  ColumnGrid& columns = voxels_->columns;
  if (!columns.is_unknown(layer_of(base.position.x(), cell_m), layer_of(base.position.y(), cell_m)))
    return;
  const CellDisc disc(base.position, ground.reach_m(), cell_m);
  columns.reserve(disc.low(), disc.high());
  const auto starts_on = [&](const Vector2& place) {
    const Vector2 here = in_body(place, base);
    const auto hides = [&](const BlindWall& wall) { return wall.hides(place); };
    return ground.is_under_body(here) ||
           (ground.contains(here) && std::none_of(walls.begin(), walls.end(), hides));
  };
  disc.for_each([&](int x, int y) {
    if (columns.is_unknown(x, y) && starts_on(cell_m * Vector2(x + 0.5, y + 0.5)))
      voxels_->update({x, y, voxels_->scan_layer}, false);
  });
}

void OccupancyMap::clear_body(const Pose& base, const Footprint& footprint) {
  if (!is_usable(base.position)) return;
  const double cell_m = options_.resolution_m;
  CellDisc(base.position, footprint.circumscribed_radius_m(), cell_m).for_each([&](int x, int y) {
    const Vector2 place = cell_m * Vector2(x + 0.5, y + 0.5);
    if (footprint.depth_m(in_body(place, base)) > 0.0) voxels_->clear_column(x, y);
  });
}

void OccupancyMap::clear_disc(const Vector2& centre, double radius_m) {
  if (!is_usable(centre)) return;
  CellDisc(centre, radius_m, options_.resolution_m).for_each([this](int x, int y) {
    voxels_->clear_column(x, y);
  });
}

OccupancyGrid OccupancyMap::slice(double border_m) const {
  return voxels_->columns.slice(static_cast<int>(std::ceil(border_m / options_.resolution_m)));
}

const CornerWindow& OccupancyMap::known_cells() const { return voxels_->columns.known(); }

void OccupancyMap::copy_slice(const CornerWindow& cells, const Eigen::Vector2i& origin,
                              OccupancyGrid& grid) const {
  voxels_->columns.copy(cells, origin, grid);
}

std::vector<CornerWindow> OccupancyMap::take_changes() { return voxels_->columns.take_changes(); }

bool OccupancyMap::is_surely_free(const Vector2& point) const {
  const VoxelIndex voxel{layer_of(point.x(), options_.resolution_m),
                         layer_of(point.y(), options_.resolution_m), voxels_->scan_layer};
  return voxels_->is_surely_free(voxels_->columns.log_odds(voxel));
}

bool OccupancyMap::is_occupied_within(const Vector2& centre, double radius_m, bool surely) const {
  bool found = false;
  CellDisc(centre, radius_m, options_.resolution_m).for_each([&](int x, int y) {
    const float log_odds = voxels_->columns.log_odds({x, y, voxels_->scan_layer});
    found = found ||
            (surely ? voxels_->is_surely_occupied(log_odds) : ColumnGrid::is_occupied(log_odds));
  });
  return found;
}

bool OccupancyMap::is_unknown_within(const Vector2& centre, double radius_m) const {
  bool unknown = true;
  CellDisc(centre, radius_m, options_.resolution_m).for_each([&](int x, int y) {
    unknown = unknown && std::isnan(voxels_->columns.log_odds({x, y, voxels_->scan_layer}));
  });
  return unknown;
}

std::uint64_t OccupancyMap::version() const { return version_before_ + voxels_->columns.version(); }

std::vector<Eigen::Vector3f> OccupancyMap::occupied_voxels() const {
  std::vector<Eigen::Vector3f> centres;
  for (const VoxelIndex& voxel : voxels_->columns.occupied()) {
    centres.push_back(
        (Eigen::Vector3d(voxel[0], voxel[1], voxel[2]).array() + 0.5).matrix().cast<float>() *
        static_cast<float>(options_.resolution_m));
  }
  return centres;
}

void OccupancyMap::save(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending == ".yaml") return save_map_image(slice(0.0), path);
  if (ending != ".bt" && ending != ".ot") {
    throw MapError(path + ": a map's name must end in .bt, .ot or .yaml");
  }
  write_file(path, voxels_->written(ending == ".bt"));
}

std::string OccupancyMap::load(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  std::ostringstream notes;
  const auto replace_by = [&](double resolution_m, const auto& read) {
    name_file(path, [&] {
      OccupancyMapOptions options = options_;
      options.resolution_m = resolution_m;
      auto voxels = std::make_unique<VoxelBand>(options.checked());
      read(*voxels);
      if (resolution_m > largest_cell_m_ + kSameCell_m) {
        options.resolution_m = largest_cell_m_;
        auto resampled = std::make_unique<VoxelBand>(options);
        resample(*voxels, *resampled);
        voxels = std::move(resampled);
        notes << "; its cells of " << resolution_m << " m are resampled to " << largest_cell_m_
              << " m";
      }
      options_ = options;
      replace(std::move(voxels));
    });
  };
  if (ending == ".bt" || ending == ".ot") {
    OctreeFile file = parse_octree_file(read_file(path), path);
    replace_by(file.resolution_m, [&](VoxelBand& voxels) { voxels.read_tree(std::move(file)); });
  } else if (ending == ".yaml") {
    OccupancyGrid grid = load_map_image(path);
    const double shift_m = move_to_lattice(grid).norm();
    if (shift_m > kSameCell_m)
      notes << "; its origin is no multiple of its cells, and moved by " << shift_m << " m";
    replace_by(grid.resolution_m, [&](VoxelBand& voxels) { voxels.read_grid(grid); });
  } else {
    throw MapError(path + ": a map's name must end in .bt, .ot or .yaml");
  }
  return notes.str();
}

void OccupancyMap::take(OccupancyMap& other) { replace(std::move(other.voxels_)); }

void OccupancyMap::clear() { replace(std::make_unique<VoxelBand>(options_)); }

void OccupancyMap::replace(std::unique_ptr<VoxelBand> voxels) {
  version_before_ = version() + 1;
  ++replaced_;
  voxels_ = std::move(voxels);
}

}  // namespace mocha
