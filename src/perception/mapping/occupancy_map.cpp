#include "perception/mapping/occupancy_map.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "perception/mapping/cell_disc.h"
#include "perception/mapping/column_grid.h"
#include "perception/mapping/grid_beam.h"
#include "perception/mapping/map_image.h"
#include "perception/mapping/octree_file.h"
#include "perception/mapping/scan_tree.h"

namespace mocha {
namespace {

/// A place of the map in the frame of a body.
Vector2 in_body(const Vector2& place, const Pose& base) {
  return turned(place - base.position, {std::cos(base.yaw_rad), -std::sin(base.yaw_rad)});
}

int layer_of(double height_m, double resolution_m) {
  return static_cast<int>(std::floor(height_m / resolution_m));
}

ColumnGrid columns_of(const OccupancyMapOptions& o) {
  const int scan = layer_of(o.scan_height_m, o.resolution_m);
  const int first = static_cast<int>(std::ceil(o.min_height_m / o.resolution_m - 0.5));
  const int last = static_cast<int>(std::floor(o.max_height_m / o.resolution_m - 0.5));
  return ColumnGrid(o.resolution_m, std::min(first, scan), std::max(last, scan));
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

/// The octree, the dense copy of its height band, and what changes both together.
struct OccupancyMap::Voxels {
  explicit Voxels(const OccupancyMapOptions& o)
      : tree(o.resolution_m),
        columns(columns_of(o)),
        scan_layer(layer_of(o.scan_height_m, o.resolution_m)) {
    tree.setProbHit(o.hit_probability);
    tree.setProbMiss(o.miss_probability);
    tree.setClampingThresMin(o.lowest_probability);
    tree.setClampingThresMax(o.highest_probability);
  }

  VoxelState state_of(const octomap::OcTreeNode& node) const {
    const float log_odds = node.getLogOdds();
    if (tree.isNodeOccupied(node)) {
      return log_odds >= tree.getClampingThresMaxLog() ? VoxelState::kOccupiedSure
                                                       : VoxelState::kOccupied;
    }
    return log_odds <= tree.getClampingThresMinLog() ? VoxelState::kFreeSure : VoxelState::kFree;
  }

  void update(const VoxelIndex& voxel, bool hit) {
    if (columns.at(voxel) == (hit ? VoxelState::kOccupiedSure : VoxelState::kFreeSure)) return;
    octomap::OcTreeNode* node = tree.leaf(key_of(voxel));
    tree.updateNodeLogOdds(node, hit ? tree.getProbHitLog() : tree.getProbMissLog());
    columns.set(voxel, state_of(*node));
  }

  void set(const VoxelIndex& voxel, float log_odds) {
    octomap::OcTreeNode* node = tree.leaf(key_of(voxel));
    node->setLogOdds(log_odds);
    columns.set(voxel, state_of(*node));
  }

  /// Nothing occupied is left in a column.
  void clear_column(int x, int y) {
    for (int k = columns.first_layer(); k <= columns.last_layer(); ++k) {
      if (is_occupied(columns.at({x, y, k}))) set({x, y, k}, tree.getProbMissLog());
    }
  }

  void insert(const std::vector<GridBeam>& beams) {
    if (beams.empty()) return;
    const VoxelBox box = box_of(beams);
    columns.reserve(box.low, box.high);
    raster.reset(box);
    for (const GridBeam& beam : beams) raster.add(beam);
    raster.for_each([this](const VoxelIndex& voxel, bool hit) { update(voxel, hit); });
  }

  void read_tree(const OctreeFile& file);
  void read_grid(const OccupancyGrid& grid);

  ScanTree tree;
  ColumnGrid columns;
  int scan_layer;
  BeamRaster raster;
};

void OccupancyMap::Voxels::read_tree(const OctreeFile& file) {
  if (file.nodes.empty()) return;
  std::istringstream nodes(file.nodes);
  file.binary ? tree.readBinaryData(nodes) : tree.readData(nodes);
  const octomap::OcTreeKey low(0, 0, key_of({0, 0, columns.first_layer()})[2]);
  const octomap::OcTreeKey high(65535, 65535, key_of({0, 0, columns.last_layer()})[2]);
  for (auto leaf = tree.begin_leafs_bbx(low, high); leaf != tree.end_leafs_bbx(); ++leaf) {
    const octomap::OcTreeKey key = leaf.getIndexKey();
    const int size = 1 << (ScanTree::kDepth - leaf.getDepth());
    const int x = key[0] - kKeyOrigin;
    const int y = key[1] - kKeyOrigin;
    const int z = key[2] - kKeyOrigin;
    columns.reserve({x, y, 0}, {x + size - 1, y + size - 1, 0});
    const int top = std::min(z + size - 1, columns.last_layer());
    for (int k = std::max(z, columns.first_layer()); k <= top; ++k) {
      for (int j = y; j < y + size; ++j) {
        for (int i = x; i < x + size; ++i) columns.set({i, j, k}, state_of(*leaf));
      }
    }
  }
}

void OccupancyMap::Voxels::read_grid(const OccupancyGrid& grid) {
  const Vector2 corner = (grid.origin / grid.resolution_m).array().round();
  if (!(corner.array().abs() < kKeyOrigin).all()) throw MapError("its origin is too far away");
  const int x0 = static_cast<int>(corner.x());
  const int y0 = static_cast<int>(corner.y());
  columns.reserve({x0, y0, 0}, {x0 + grid.width - 1, y0 + grid.height - 1, 0});
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      if (grid.at(x, y) == OccupancyGrid::kUnknown) continue;
      set({x0 + x, y0 + y, scan_layer}, grid.at(x, y) == OccupancyGrid::kOccupied
                                            ? tree.getClampingThresMaxLog()
                                            : tree.getClampingThresMinLog());
    }
  }
}

OccupancyMap::OccupancyMap(const OccupancyMapOptions& options)
    : options_(options.checked()), voxels_(std::make_unique<Voxels>(options_)) {}

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

bool OccupancyMap::is_surely_free(const Vector2& point) const {
  const VoxelIndex voxel{layer_of(point.x(), options_.resolution_m),
                         layer_of(point.y(), options_.resolution_m), voxels_->scan_layer};
  return voxels_->columns.at(voxel) == VoxelState::kFreeSure;
}

bool OccupancyMap::is_occupied_within(const Vector2& centre, double radius_m, bool surely) const {
  bool found = false;
  CellDisc(centre, radius_m, options_.resolution_m).for_each([&](int x, int y) {
    const VoxelState state = voxels_->columns.at({x, y, voxels_->scan_layer});
    found = found || (surely ? state == VoxelState::kOccupiedSure : is_occupied(state));
  });
  return found;
}

bool OccupancyMap::is_unknown_within(const Vector2& centre, double radius_m) const {
  bool unknown = true;
  CellDisc(centre, radius_m, options_.resolution_m).for_each([&](int x, int y) {
    const VoxelState state = voxels_->columns.at({x, y, voxels_->scan_layer});
    unknown = unknown && state == VoxelState::kUnknown;
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
  const bool binary = ending == ".bt";
  ScanTree& tree = voxels_->tree;
  tree.updateInnerOccupancy();
  std::ostringstream bytes;
  bytes << octree_header(binary, tree.size(), options_.resolution_m);
  if (tree.size() > 0) binary ? tree.writeBinaryData(bytes) : tree.writeData(bytes);
  write_file(path, bytes.str());
}

void OccupancyMap::load(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  const auto replace_by = [&](double resolution_m, const auto& read) {
    name_file(path, [&] {
      OccupancyMapOptions options = options_;
      options.resolution_m = resolution_m;
      auto voxels = std::make_unique<Voxels>(options.checked());
      read(*voxels);
      options_ = options;
      replace(std::move(voxels));
    });
  };
  if (ending == ".bt" || ending == ".ot") {
    const OctreeFile file = parse_octree_file(read_file(path), path);
    replace_by(file.resolution_m, [&](Voxels& voxels) { voxels.read_tree(file); });
  } else if (ending == ".yaml") {
    const OccupancyGrid grid = load_map_image(path);
    replace_by(grid.resolution_m, [&](Voxels& voxels) { voxels.read_grid(grid); });
  } else {
    throw MapError(path + ": a map's name must end in .bt, .ot or .yaml");
  }
}

void OccupancyMap::clear() { replace(std::make_unique<Voxels>(options_)); }

void OccupancyMap::replace(std::unique_ptr<Voxels> voxels) {
  version_before_ = version() + 1;
  voxels_ = std::move(voxels);
}

}  // namespace mocha
