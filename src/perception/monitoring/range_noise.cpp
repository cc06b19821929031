#include "perception/monitoring/range_noise.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mocha {
namespace {

constexpr float kFarthestRange_m = 6.0f;  // farther away, neighbours are too far apart
constexpr std::size_t kFewest = 60;
constexpr double kMedianOfNormal = 0.6745;  // of the absolute value, in standard deviations

}  // namespace

std::optional<double> range_noise_m(const PlanarScan& scan) {
  const auto is_near = [&](float range) {
    return range >= scan.range_min_m &&
           range < std::min<double>(scan.range_max_m, kFarthestRange_m);
  };
  std::vector<double> off_m;
  const std::vector<float>& r = scan.ranges_m;
  for (std::size_t i = 1; i + 1 < r.size(); ++i) {
    if (!is_near(r[i - 1]) || !is_near(r[i]) || !is_near(r[i + 1])) continue;
    // Hits on a straight line have inverse ranges that are linear in the sine and cosine of their
    // angles; this is what r[i] is off by.
    const double expected =
        2.0 * std::cos(scan.angle_increment_rad) / (1.0 / r[i - 1] + 1.0 / r[i + 1]);
    off_m.push_back(std::abs(r[i] - expected));
  }
  if (off_m.size() < kFewest) return std::nullopt;
  const auto middle = off_m.begin() + static_cast<std::ptrdiff_t>(off_m.size() / 2);
  std::nth_element(off_m.begin(), middle, off_m.end());
  return *middle / kMedianOfNormal / std::sqrt(1.5);  // of three ranges, weighted 1/2, 1, 1/2
}

}  // namespace mocha
