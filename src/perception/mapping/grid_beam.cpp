#include "perception/mapping/grid_beam.h"

#include <algorithm>
#include <cmath>

namespace mocha {

bool clip_height(GridBeam& beam, double low, double high) {
  const Vector3 way = beam.end - beam.origin;
  double enter = 0.0;
  double leave = 1.0;
  if (way.z() == 0.0) {
    if (beam.origin.z() < low || beam.origin.z() > high) return false;
  } else {
    const double a = (low - beam.origin.z()) / way.z();
    const double b = (high - beam.origin.z()) / way.z();
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (enter > leave) return false;
  if (leave < 1.0) beam.kind = BeamEnd::kMiss;
  beam.end = beam.origin + leave * way;
  beam.origin += enter * way;
  beam.origin.z() = std::clamp(beam.origin.z(), low, high);
  beam.end.z() = std::clamp(beam.end.z(), low, high);
  return true;
}

namespace {

VoxelIndex index_of(const Vector3& p) {
  return {static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y())),
          static_cast<int>(std::floor(p.z()))};
}

}  // namespace

VoxelBox box_of(const std::vector<GridBeam>& beams) {
  Vector3 low = beams.front().origin;
  Vector3 high = low;
  for (const GridBeam& beam : beams) {
    low = low.cwiseMin(beam.origin).cwiseMin(beam.end);
    high = high.cwiseMax(beam.origin).cwiseMax(beam.end);
  }
  return {index_of(low), index_of(high)};
}

}  // namespace mocha
