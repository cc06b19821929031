#include "perception/sensor/range_smoothing.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mocha {
namespace {

constexpr int kMostNeighbours = 16;  // on each side: more do not help, and cost time
// So much farther than the inner ones, the outer ones of many neighbours lie behind an edge; of two
// it takes more, as their noise does not cancel out.
constexpr double kBehind_m = 0.006;
constexpr double kBehindOfTwo_m = 0.018;

/// Sums of ranges about a hit: with no neighbours, with one on each side, and so on.
class Neighbourhood {
 public:
  explicit Neighbourhood(double range_m) { sums_m_[0] = range_m; }

  int sides() const { return sides_; }  ///< neighbours on each side
  void add(double pair_m) {
    ++sides_;
    sums_m_[sides_] = sums_m_[sides_ - 1] + pair_m;
  }

  /// The mean over as many as do not reach behind an edge.
  double mean_m() const {
    int outer = sides_;
    while (outer > 0 && mean_m(outer, outer / 2) > mean_m(outer / 2) + behind_m(outer)) outer /= 2;
    return mean_m(outer);
  }

 private:
  static double behind_m(int sides) {
    return std::max(kBehind_m, kBehindOfTwo_m / std::sqrt(static_cast<double>(sides)));
  }
  double mean_m(int sides) const { return sums_m_[sides] / (2 * sides + 1); }
  /// Of those beyond the inner ones.
  double mean_m(int sides, int inner) const {
    return (sums_m_[sides] - sums_m_[inner]) / (2 * (sides - inner));
  }

  std::array<double, kMostNeighbours + 1> sums_m_{};
  int sides_ = 0;
};

/// Whether the last beam is the neighbour of the first.
bool is_all_round(const PlanarScan& scan) {
  const double turn_rad = scan.ranges_m.size() * scan.angle_increment_rad;
  return std::abs(std::abs(turn_rad) - 2.0 * M_PI) < 1.5 * std::abs(scan.angle_increment_rad);
}

}  // namespace

PlanarScan smoothed(const PlanarScan& scan, double reach_m) {
  const int count = static_cast<int>(scan.ranges_m.size());
  const auto is_near = [&](int i, int j) {
    const double a = scan.ranges_m[i];
    const double b = scan.ranges_m[j];
    if (!(b >= scan.range_min_m && b < scan.range_max_m)) return false;
    const double angle_rad = (j - i) * scan.angle_increment_rad;
    return a * a + b * b - 2.0 * a * b * std::cos(angle_rad) <= reach_m * reach_m;
  };
  PlanarScan result = scan;
  const bool all_round = is_all_round(scan);
  for (int i = 0; i < count; ++i) {
    if (!is_near(i, i)) continue;
    const int room = all_round ? (count - 1) / 2 : std::min(i, count - 1 - i);
    Neighbourhood about(scan.ranges_m[i]);
    for (int k = 1; k <= std::min(kMostNeighbours, room); ++k) {
      const int before = (i - k + count) % count;
      const int after = (i + k) % count;
      if (!is_near(i, before) || !is_near(i, after)) break;
      about.add(scan.ranges_m[before] + scan.ranges_m[after]);
    }
    result.ranges_m[i] = static_cast<float>(about.mean_m());
  }
  return result;
}

}  // namespace mocha
