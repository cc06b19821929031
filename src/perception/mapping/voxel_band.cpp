#include "perception/mapping/voxel_band.h"

#include <octomap/octomap_utils.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "perception/mapping/grid_beam.h"
#include "perception/mapping/map_error.h"
#include "perception/mapping/scan_tree.h"

namespace mocha {
namespace {

ColumnGrid columns_of(const OccupancyMapOptions& o) {
  const int scan = layer_of(o.scan_height_m, o.resolution_m);
  const int first = static_cast<int>(std::ceil(o.min_height_m / o.resolution_m - 0.5));
  const int last = static_cast<int>(std::floor(o.max_height_m / o.resolution_m - 0.5));
  return ColumnGrid(o.resolution_m, std::min(first, scan), std::max(last, scan));
}

}  // namespace

VoxelBand::VoxelBand(const OccupancyMapOptions& o)
    : resolution_m(o.resolution_m),
      hit(octomap::logodds(o.hit_probability)),
      miss(octomap::logodds(o.miss_probability)),
      lowest(octomap::logodds(o.lowest_probability)),
      highest(octomap::logodds(o.highest_probability)),
      columns(columns_of(o)),
      scan_layer(layer_of(o.scan_height_m, o.resolution_m)) {}

void VoxelBand::update(const VoxelIndex& voxel, bool is_hit) {
  const float before = columns.log_odds(voxel);
  if (is_hit ? is_surely_occupied(before) : is_surely_free(before)) return;
  const float from = std::isnan(before) ? 0.0f : before;
  columns.set(voxel, std::clamp(from + (is_hit ? hit : miss), lowest, highest));
}

void VoxelBand::clear_column(int x, int y) {
  for (int k = columns.first_layer(); k <= columns.last_layer(); ++k) {
    if (ColumnGrid::is_occupied(columns.log_odds({x, y, k}))) columns.set({x, y, k}, miss);
  }
}

void VoxelBand::insert(const std::vector<GridBeam>& beams) {
  if (beams.empty()) return;
  const VoxelBox box = box_of(beams);
  columns.reserve(box.low, box.high);
  raster.reset(box);
  for (const GridBeam& beam : beams) raster.add(beam);
  raster.for_each([this](const VoxelIndex& voxel, bool is_hit) { update(voxel, is_hit); });
}

void VoxelBand::read_tree(OctreeFile file) {
  const int first = columns.first_layer();
  const int last = columns.last_layer();
  bool is_more = false;
  for_each_leaf(file, lowest, highest, [&](const OctreeLeaf& leaf) {
    const auto [x, y, z] = leaf.low;
    const int end = z + leaf.size;
    is_more = is_more || z < first || end - 1 > last;
    if (z > last || end <= first) return;
    columns.reserve({x, y, 0}, {x + leaf.size - 1, y + leaf.size - 1, 0});
    for (int k = std::max(z, first); k <= std::min(end - 1, last); ++k) {
      for (int j = y; j < y + leaf.size; ++j) {
        for (int i = x; i < x + leaf.size; ++i) columns.set({i, j, k}, leaf.log_odds);
      }
    }
  });
  if (is_more) beyond = std::move(file);
}

std::string VoxelBand::written(bool binary) const {
  ScanTree tree(resolution_m);
  if (beyond) {
    tree.setClampingThresMin(octomap::probability(lowest));
    tree.setClampingThresMax(octomap::probability(highest));
    std::istringstream nodes(beyond->nodes);
    beyond->binary ? tree.readBinaryData(nodes) : tree.readData(nodes);
  }
  columns.for_each_known([&](const VoxelIndex& voxel, float log_odds) {
    tree.leaf(key_of(voxel))->setLogOdds(log_odds);
  });
  tree.updateInnerOccupancy();
  std::ostringstream bytes;
  bytes << octree_header(binary, tree.size(), resolution_m);
  if (tree.size() > 0) binary ? tree.writeBinaryData(bytes) : tree.writeData(bytes);
  return bytes.str();
}

void VoxelBand::read_grid(const OccupancyGrid& grid) {
  const Vector2 corner = (grid.origin / grid.resolution_m).array().round();
  if (!(corner.array().abs() < kKeyOrigin).all()) throw MapError("its origin is too far away");
  const int x0 = static_cast<int>(corner.x());
  const int y0 = static_cast<int>(corner.y());
  columns.reserve({x0, y0, 0}, {x0 + grid.width - 1, y0 + grid.height - 1, 0});
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      if (grid.at(x, y) == OccupancyGrid::kUnknown) continue;
      columns.set({x0 + x, y0 + y, scan_layer},
                  grid.at(x, y) == OccupancyGrid::kOccupied ? highest : lowest);
    }
  }
}

}  // namespace mocha
