#include "benchmarks/maps_log.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace mocha {
namespace {

constexpr double kCell_m = 0.05;
constexpr double kFarthest_m = 20.0;  // beams that end beyond say nothing there
constexpr double kRobot_m = 0.35;
constexpr double kLeastShare = 0.25;  // of the beams that come to a cell, ending in it: occupied

struct Scan {
  Vector2 position;
  double yaw_rad;
  std::vector<double> ranges_m;  // from -90 degrees on, evenly to about 90

  Vector2 end(std::size_t beam, double range_m) const {
    const double step_rad = M_PI / std::round(static_cast<double>(ranges_m.size()) / 180.0) / 180.0;
    const double angle_rad = yaw_rad - 0.5 * M_PI + static_cast<double>(beam) * step_rad;
    return position + range_m * Vector2(std::cos(angle_rad), std::sin(angle_rad));
  }
};

std::vector<Scan> scans_of(std::istream& log) {
  std::vector<Scan> scans;
  std::string line;
  while (std::getline(log, line)) {
    std::istringstream words(line);
    std::string word;
    std::size_t count = 0;
    if (!(words >> word >> count) || word != "FLASER") continue;
    Scan scan;
    scan.ranges_m.resize(count);
    for (double& range_m : scan.ranges_m) words >> range_m;
    if (words >> scan.position.x() >> scan.position.y() >> scan.yaw_rad) scans.push_back(scan);
  }
  return scans;
}

/// How many beams came to each cell, and how many ended there.
class Counts {
 public:
  explicit Counts(const OccupancyGrid& grid)
      : grid_(grid), passed_(grid.cells.size(), 0), ended_(grid.cells.size(), 0) {}

  void add(const Scan& scan) {
    for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
      const double range_m = scan.ranges_m[beam];
      const double free_m = std::min(range_m, kFarthest_m);
      for (double along_m = 0.0; along_m < free_m - kCell_m; along_m += 0.5 * kCell_m)
        count(scan.end(beam, along_m), passed_);
      if (range_m < kFarthest_m) count(scan.end(beam, range_m), ended_);
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
  const std::vector<Scan> scans = scans_of(log);
  if (scans.empty()) throw std::invalid_argument("the log has no scans (FLASER)");
  Eigen::AlignedBox2d box;
  for (const Scan& scan : scans) {
    box.extend(scan.position);
    for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
      if (scan.ranges_m[beam] < kFarthest_m) box.extend(scan.end(beam, scan.ranges_m[beam]));
    }
  }
  Building made;
  made.start = scans.front().position;
  made.goal = std::max_element(scans.begin(), scans.end(), [&](const Scan& a, const Scan& b) {
                return (a.position - made.start).norm() < (b.position - made.start).norm();
              })->position;
  made.grid.resolution_m = kCell_m;
  made.grid.origin = box.min() - Vector2(1.0, 1.0);
  made.grid.width = static_cast<int>((box.sizes().x() + 2.0) / kCell_m);
  made.grid.height = static_cast<int>((box.sizes().y() + 2.0) / kCell_m);
  made.grid.cells.resize(static_cast<std::size_t>(made.grid.width) * made.grid.height);
  Counts counts(made.grid);
  for (const Scan& scan : scans) counts.add(scan);
  for (std::size_t cell = 0; cell < made.grid.cells.size(); ++cell)
    made.grid.cells[cell] = counts.value(cell);
  for (const Scan& scan : scans)
    fill_disc(made.grid, scan.position, kRobot_m, OccupancyGrid::kFree);
  return made;
}

}  // namespace mocha
