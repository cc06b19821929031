#include "topology/path_shortening.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mocha {
namespace {

constexpr int kPoints = 60;       // from which corners are cut, about
constexpr double kFinest = 4.0;   // such points are at least this many details apart
constexpr int kMostFailures = 4;  // in a row, before a shortcut is as long as it can be
constexpr double kNoDearer_m = 1e-6;

/// The same path with more points on it.
std::vector<Vector2> refined(const std::vector<Vector2>& path, double spacing_m) {
  std::vector<Vector2> points = {path.front()};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vector2 step = path[i] - path[i - 1];
    const int parts = 1 + static_cast<int>(step.norm() / spacing_m);
    for (int k = 1; k < parts; ++k) points.push_back(path[i - 1] + step * k / parts);
    points.push_back(path[i]);
  }
  return points;
}

/// Cuts corners from the front to the back.
std::vector<Vector2> cut_corners(const std::vector<Vector2>& points, const TravelCost& cost,
                                 const Cuts<2>& cuts) {
  std::vector<double> cost_to(points.size(), 0.0);
  std::vector<SignatureKey> key_to(points.size(), 0);
  for (std::size_t i = 1; i < points.size(); ++i) {
    cost_to[i] = cost_to[i - 1] + cost.of_line(points[i - 1], points[i]);
    key_to[i] = key_to[i - 1] + key_of<2>(cuts, points[i - 1], points[i]);
  }
  std::vector<Vector2> shorter = {points.front()};
  for (std::size_t from = 0; from + 1 < points.size();) {
    std::size_t to = from + 1;
    int failures = 0;
    for (std::size_t next = from + 2; next < points.size() && failures < kMostFailures; ++next) {
      const bool same_class =
          key_of<2>(cuts, points[from], points[next]) == key_to[next] - key_to[from];
      const double straight =
          same_class ? cost.of_line(points[from], points[next]) : TravelCost::kInfinity;
      const bool cheap = straight < TravelCost::kInfinity &&
                         straight <= cost_to[next] - cost_to[from] + kNoDearer_m;
      failures = cheap ? 0 : failures + 1;
      if (cheap) to = next;
    }
    shorter.push_back(points[to]);
    from = to;
  }
  return shorter;
}

double length_of(const std::vector<Vector2>& path) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length_m += (path[i] - path[i - 1]).norm();
  return length_m;
}

}  // namespace

double cost_of(const std::vector<Vector2>& path, const TravelCost& cost) {
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += cost.of_line(path[i - 1], path[i]);
  return sum;
}

std::vector<Vector2> shortened(const std::vector<Vector2>& path, const TravelCost& cost,
                               const Cuts<2>& cuts) {
  if (path.size() < 2) return path;
  std::vector<Vector2> shorter = path;
  // Backwards as well, as what is cut first bends what is cut later.
  for (int round = 0; round < 2; ++round) {
    const double spacing_m =
        std::max(kFinest * cost.terrain().detail_m(), length_of(shorter) / kPoints);
    std::vector<Vector2> next = cut_corners(refined(shorter, spacing_m), cost, cuts);
    // In the narrowest places a part of a line may fail where the whole has passed.
    if (!(cost_of(next, cost) < TravelCost::kInfinity)) next = cut_corners(shorter, cost, cuts);
    std::reverse(next.begin(), next.end());
    shorter = std::move(next);
  }
  return shorter;
}

}  // namespace mocha
