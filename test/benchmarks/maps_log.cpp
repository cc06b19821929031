#include "benchmarks/maps_log.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "benchmarks/carmen_log.h"

namespace mocha {
namespace {

constexpr double kCell_m = 0.05;
constexpr double kFarthest_m = 20.0;  // beams that end beyond say nothing there
constexpr double kRobot_m = 0.35;
constexpr double kLeastShare = 0.25;  // of the beams that come to a cell, ending in it: occupied

/// Where a beam of that length ends.
Vector2 end_of(const LoggedScan& scan, std::size_t beam, double range_m) {
  const double angle_rad = scan.laser.yaw_rad + scan.angle_rad(beam);
  return scan.laser.position + range_m * Vector2(std::cos(angle_rad), std::sin(angle_rad));
}

/// How many beams came to each cell, and how many ended there.
class Counts {
 public:
  explicit Counts(const OccupancyGrid& grid)
      : grid_(grid), passed_(grid.cells.size(), 0), ended_(grid.cells.size(), 0) {}

  void add(const LoggedScan& scan) {
    for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
      const double range_m = scan.ranges_m[beam];
      const double free_m = std::min(range_m, kFarthest_m);
      for (double along_m = 0.0; along_m < free_m - kCell_m; along_m += 0.5 * kCell_m)
        count(end_of(scan, beam, along_m), passed_);
      if (range_m < kFarthest_m) count(end_of(scan, beam, range_m), ended_);
    }
  }

  std::int8_t value(std::size_t cell) const {
    // A beam comes to a cell twice, about.
    const bool is_free =
        passed_[cell] > 0 && ended_[cell] < kLeastShare * (ended_[cell] + 0.5 * passed_[cell]);
    return is_free ? OccupancyGrid::kFree : OccupancyGrid::kOccupied;
  }

 private:
  void count(const Vector2& place, std::vector<int>& counts) const {
    const Vector2 at = (place - grid_.origin) / kCell_m;
    const int x = static_cast<int>(std::floor(at.x()));
    const int y = static_cast<int>(std::floor(at.y()));
    if (grid_.contains(x, y)) ++counts[static_cast<std::size_t>(y) * grid_.width + x];
  }

  const OccupancyGrid& grid_;
  std::vector<int> passed_;
  std::vector<int> ended_;
};

}  // namespace

Building building_of_log(std::istream& log) {
  const std::vector<LoggedScan> scans = read_carmen_log(log);
  Eigen::AlignedBox2d box;
  for (const LoggedScan& scan : scans) {
    box.extend(scan.laser.position);
    for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
      if (scan.ranges_m[beam] < kFarthest_m) box.extend(end_of(scan, beam, scan.ranges_m[beam]));
    }
  }
  Building made;
  made.start = scans.front().laser.position;
  made.goal =
      std::max_element(scans.begin(), scans.end(), [&](const LoggedScan& a, const LoggedScan& b) {
        return (a.laser.position - made.start).norm() < (b.laser.position - made.start).norm();
      })->laser.position;
  made.grid.resolution_m = kCell_m;
  made.grid.origin = box.min() - Vector2(1.0, 1.0);
  made.grid.width = static_cast<int>((box.sizes().x() + 2.0) / kCell_m);
  made.grid.height = static_cast<int>((box.sizes().y() + 2.0) / kCell_m);
  made.grid.cells.resize(static_cast<std::size_t>(made.grid.width) * made.grid.height);
  Counts counts(made.grid);
  for (const LoggedScan& scan : scans) counts.add(scan);
  for (std::size_t cell = 0; cell < made.grid.cells.size(); ++cell)
    made.grid.cells[cell] = counts.value(cell);
  for (const LoggedScan& scan : scans)
    fill_disc(made.grid, scan.laser.position, kRobot_m, OccupancyGrid::kFree);
  return made;
}

}  // namespace mocha
