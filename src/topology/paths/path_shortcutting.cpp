#include "topology/paths/path_shortcutting.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trajectory/polyline.h"

namespace mocha {
namespace {

constexpr int kPoints = 50;          // from which corners are cut, about
constexpr double kFinest = 4.0;      // such points are at least this many details apart
constexpr int kRounds = 3;           // to and fro, at most
constexpr double kWorthwhile = 0.1;  // another round is, after one that gained this share
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
class CornerCutter {
 public:
  CornerCutter(const std::vector<Vector2>& points, const TravelCost& cost, const Cuts<2>& cuts)
      : points_(points), cost_(cost), cuts_(cuts), to_(points.size()) {
    for (std::size_t i = 1; i < points.size(); ++i) {
      to_[i].cost = to_[i - 1].cost + cost.of_line(points[i - 1], points[i]);
      to_[i].key = to_[i - 1].key + key_of<2>(cuts, points[i - 1], points[i]);
    }
  }

  std::vector<Vector2> run() {
    std::vector<Vector2> shorter = {points_.front()};
    Reached here;
    for (std::size_t next = 1; next < points_.size();) {
      const std::size_t farthest = farthest_from(shorter.back(), here, next);
      const bool is_new = farthest > next && farthest + 1 < points_.size();
      // On from the middle, which is closer to what the path bends around than the end is.
      const Vector2 middle = 0.5 * (shorter.back() + points_[farthest]);
      const double first = is_new ? cost_.of_line(shorter.back(), middle) : TravelCost::kInfinity;
      const double second =
          is_new ? cost_.of_line(middle, points_[farthest]) : TravelCost::kInfinity;
      if (first + second <= to_[farthest].cost - here.cost + kNoDearer_m) {
        here = {to_[farthest].cost - second,
                to_[farthest].key - key_of<2>(cuts_, middle, points_[farthest])};
        shorter.push_back(middle);
        next = farthest;
      } else {
        here = to_[farthest];
        shorter.push_back(points_[farthest]);
        next = farthest + 1;
      }
    }
    return shorter;
  }

 private:
  struct Reached {
    double cost = 0.0;
    SignatureKey key = 0;
  };

  /// One of the last points that the straight line leads to; the one given can be reached. Strides
  /// double while they succeed and halve when they fail.
  std::size_t farthest_from(const Vector2& p, const Reached& here, std::size_t reachable) const {
    std::size_t farthest = reachable;
    std::size_t stride = 1;
    for (bool growing = true; stride > 0;) {
      const std::size_t next = farthest + stride;
      const bool reached = next < points_.size() && is_no_dearer(p, here, next);
      if (reached) farthest = next;
      growing = growing && reached;
      stride = growing ? 2 * stride : stride / 2;
    }
    return farthest;
  }

  bool is_no_dearer(const Vector2& p, const Reached& here, std::size_t i) const {
    if (key_of<2>(cuts_, p, points_[i]) != to_[i].key - here.key) return false;
    const double straight = cost_.of_line(p, points_[i]);
    return straight < TravelCost::kInfinity && straight <= to_[i].cost - here.cost + kNoDearer_m;
  }

  const std::vector<Vector2>& points_;
  const TravelCost& cost_;
  const Cuts<2>& cuts_;
  std::vector<Reached> to_;  // each of the points, along the path
};

/// One round of cutting; returns the path from its end to its start.
std::vector<Vector2> cut_back_to_front(const std::vector<Vector2>& path, const TravelCost& cost,
                                       const Cuts<2>& cuts) {
  const double spacing_m =
      std::max(kFinest * cost.static_map().detail_m(), length_of(path) / kPoints);
  std::vector<Vector2> next = CornerCutter(refined(path, spacing_m), cost, cuts).run();
  // In the narrowest places a part of a line may fail where the whole has passed.
  if (!(cost_of(next, cost) < TravelCost::kInfinity)) next = CornerCutter(path, cost, cuts).run();
  std::reverse(next.begin(), next.end());
  return next;
}

}  // namespace

double cost_of(const std::vector<Vector2>& path, const TravelCost& cost) {
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += cost.of_line(path[i - 1], path[i]);
  return sum;
}

std::vector<Vector2> with_shortcuts(const std::vector<Vector2>& path, const TravelCost& cost,
                                    const Cuts<2>& cuts) {
  if (path.size() < 2) return path;
  std::vector<Vector2> shorter = path;
  double length_m = length_of(path);
  for (int round = 0; round < kRounds; ++round) {
    // Backwards as well, as what is cut first bends what is cut later.
    for (int direction = 0; direction < 2; ++direction)
      shorter = cut_back_to_front(shorter, cost, cuts);
    const double gained_m = length_m - length_of(shorter);
    length_m -= gained_m;
    if (gained_m < kWorthwhile * length_m) break;
  }
  // What is sampled anew may come out dearer by a trifle.
  return cost_of(shorter, cost) <= cost_of(path, cost) ? shorter : path;
}

}  // namespace mocha
