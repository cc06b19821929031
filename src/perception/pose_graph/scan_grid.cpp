#include "perception/pose_graph/scan_grid.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>

#include "trajectory/frame_change.h"

namespace mocha {
namespace {

constexpr double kLeastEnding = 0.25;  // of the beams that come to a cell, ending in it: occupied

/// An empty grid over all that the keyframes saw within the window.
OccupancyGrid empty_grid(const std::vector<PlacedKeyframe>& keyframes,
                         const Eigen::AlignedBox2d& window, double cell_m) {
  Eigen::AlignedBox2d box;
  for (const PlacedKeyframe& placed : keyframes) {
    box.extend(placed.pose.position);
    for (const Vector2& hit : placed.keyframe->scan.hits)
      box.extend(composed(placed.pose, {hit, 0.0}).position);
  }
  box = box.intersection(window);
  OccupancyGrid grid;
  grid.resolution_m = cell_m;
  if (box.isEmpty()) box.extend(window.center());
  grid.origin = box.min() - Vector2(cell_m, cell_m);
  grid.width = static_cast<int>(box.sizes().x() / cell_m) + 3;
  grid.height = static_cast<int>(box.sizes().y() / cell_m) + 3;
  grid.cells.assign(static_cast<std::size_t>(grid.width) * grid.height, OccupancyGrid::kUnknown);
  return grid;
}

/// How many beams came through the cells of a grid, and how many ended there.
class BeamCounts {
 public:
  explicit BeamCounts(const OccupancyGrid& grid)
      : grid_(grid), passed_(grid.cells.size(), 0), ended_(grid.cells.size(), 0) {}

  void add(const Beam& beam) {
    const Vector2 from = beam.origin.head<2>();
    const int steps = static_cast<int>(ray(beam).norm() / grid_.resolution_m - 0.5);
    for (int i = 0; i < steps; ++i) count(from + ray(beam) * i / (steps + 1), passed_);
    if (beam.kind == BeamEnd::kHit) count(beam.end.head<2>(), ended_);
  }

  std::int8_t value(std::size_t cell) const {
    if (passed_[cell] + ended_[cell] == 0) return OccupancyGrid::kUnknown;
    return ended_[cell] > 0 && ended_[cell] >= kLeastEnding * (ended_[cell] + passed_[cell])
               ? OccupancyGrid::kOccupied
               : OccupancyGrid::kFree;
  }

 private:
  void count(const Vector2& place, std::vector<int>& counts) const {
    const Vector2 at = (place - grid_.origin) / grid_.resolution_m;
    const int x = static_cast<int>(std::floor(at.x()));
    const int y = static_cast<int>(std::floor(at.y()));
    if (grid_.contains(x, y)) ++counts[static_cast<std::size_t>(y) * grid_.width + x];
  }

  const OccupancyGrid& grid_;
  std::vector<int> passed_;
  std::vector<int> ended_;
};

}  // namespace

OccupancyGrid grid_of(const std::vector<PlacedKeyframe>& keyframes, const Vector2& centre,
                      double reach_m, double cell_m) {
  const Vector2 reach = Vector2::Constant(reach_m);
  OccupancyGrid grid = empty_grid(keyframes, {centre - reach, centre + reach}, cell_m);
  BeamCounts counts(grid);
  for (const PlacedKeyframe& placed : keyframes) {
    for (const Beam& beam : beams_of(placed.keyframe->scan, placed.pose)) counts.add(beam);
  }
  for (std::size_t cell = 0; cell < grid.cells.size(); ++cell)
    grid.cells[cell] = counts.value(cell);
  return grid;
}

std::vector<Beam> lasting_beams(const PlacedKeyframe& keyframe, const OccupancyGrid& all) {
  std::vector<Beam> beams = beams_of(keyframe.keyframe->scan, keyframe.pose);
  for (Beam& beam : beams) {
    if (beam.kind == BeamEnd::kHit && !is_occupied_beside(all, beam.end.head<2>()))
      beam.kind = BeamEnd::kIgnored;
  }
  return beams;
}

}  // namespace mocha
