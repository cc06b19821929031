#include "benchmarks/carmen_log.h"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace mocha {

double LoggedScan::angle_rad(std::size_t beam) const {
  const double step_rad = M_PI / std::round(static_cast<double>(ranges_m.size()) / 180.0) / 180.0;
  return -0.5 * M_PI + static_cast<double>(beam) * step_rad;
}

Vector2 LoggedScan::hit(std::size_t beam) const {
  return ranges_m[beam] * Vector2(std::cos(angle_rad(beam)), std::sin(angle_rad(beam)));
}

std::vector<LoggedScan> read_carmen_log(std::istream& log) {
  std::vector<LoggedScan> scans;
  std::string line;
  while (std::getline(log, line)) {
    std::istringstream words(line);
    std::string word;
    std::size_t count = 0;
    if (!(words >> word >> count) || word != "FLASER") continue;
    LoggedScan scan;
    scan.ranges_m.resize(count);
    for (double& range_m : scan.ranges_m) words >> range_m;
    if (words >> scan.laser.position.x() >> scan.laser.position.y() >> scan.laser.yaw_rad)
      scans.push_back(scan);
  }
  if (scans.empty()) throw std::invalid_argument("the log has no scans (FLASER)");
  return scans;
}

}  // namespace mocha
