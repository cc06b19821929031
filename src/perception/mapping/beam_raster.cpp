#include "perception/mapping/beam_raster.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "perception/mapping/map_error.h"

namespace mocha {
namespace {

constexpr double kMostVoxels = 2e8;
constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr int kIgnoredGap = 2;  // voxels left untouched at the end of an ignored hit

}  // namespace

void BeamRaster::reset(const VoxelBox& box) {
  // Rounding may lead a walk one voxel past the box where a beam ends on an edge; in a single layer
  // it never climbs.
  const int rim = box.low[2] == box.high[2] ? 0 : 1;
  const double width = 3.0 + box.high[0] - box.low[0];
  const double height = 3.0 + box.high[1] - box.low[1];
  const double depth = 1.0 + 2.0 * rim + box.high[2] - box.low[2];
  if (!(width * height * depth <= kMostVoxels)) {
    throw MapError("a scan spans more than " + std::to_string(static_cast<int>(kMostVoxels)) +
                   " cells; lower its range or take larger cells");
  }
  box_ = box;
  strides_ = {1, static_cast<std::ptrdiff_t>(width), static_cast<std::ptrdiff_t>(width * height)};
  first_ = 0;
  first_ = -offset({box.low[0] - 1, box.low[1] - 1, box.low[2] - rim});
  marks_.assign(static_cast<std::size_t>(width * height * depth), 0);
}

void BeamRaster::add(const GridBeam& beam) {
  VoxelIndex from;
  VoxelIndex to;
  std::array<double, 3> next;  // share of the beam at which the next voxel along an axis begins
  std::array<double, 3> pace;  // share of the beam per voxel
  std::array<std::ptrdiff_t, 3> step;  // in memory
  int steps = beam.kind == BeamEnd::kIgnored ? -kIgnoredGap : 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double start = beam.origin[axis];
    const double length = std::abs(beam.end[axis] - start);
    from[axis] = static_cast<int>(std::floor(start));
    to[axis] = static_cast<int>(std::floor(beam.end[axis]));
    const bool up = to[axis] > from[axis];
    const bool stays = to[axis] == from[axis];
    pace[axis] = stays ? 0.0 : 1.0 / length;
    next[axis] = stays ? kNever : (up ? from[axis] + 1 - start : start - from[axis]) / length;
    step[axis] = up ? strides_[axis] : -strides_[axis];
    steps += std::abs(to[axis] - from[axis]);
  }
  std::uint8_t* mark = &marks_[offset(from)];
  for (; steps > 0;
       --steps) {  // without branches that depend on the beam: those cost more than all the rest
    *mark |= kFree;
    const bool y = next[1] < next[0];
    const bool z = next[2] < std::min(next[0], next[1]);
    mark += z ? step[2] : (y ? step[1] : step[0]);
    next[0] += z || y ? 0.0 : pace[0];
    next[1] += z || !y ? 0.0 : pace[1];
    next[2] += z ? pace[2] : 0.0;
  }
  if (beam.kind == BeamEnd::kHit) marks_[offset(to)] |= kHit;
  if (beam.kind == BeamEnd::kMiss) marks_[offset(to)] |= kFree;
}

}  // namespace mocha
