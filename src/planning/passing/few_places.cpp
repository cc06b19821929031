#include "planning/passing/few_places.h"

#include "world/obstacle.h"

namespace mocha {
namespace {

constexpr double kFinest_m = 0.02;  // off the path, at first

/// Keeps what is farthest off the straight line between two kept ones.
void keep_between(const std::vector<Vector2>& path, std::size_t first, std::size_t last,
                  double tolerance_m, std::vector<bool>& kept) {
  std::size_t farthest = first;
  double farthest_m = tolerance_m;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double off_m = (path[i] - nearest_on_segment(path[i], path[first], path[last])).norm();
    if (off_m <= farthest_m) continue;
    farthest_m = off_m;
    farthest = i;
  }
  if (farthest == first) return;
  kept[farthest] = true;
  keep_between(path, first, farthest, tolerance_m, kept);
  keep_between(path, farthest, last, tolerance_m, kept);
}

}  // namespace

std::vector<Vector2> few_places(const std::vector<Vector2>& path, std::size_t most) {
  if (path.size() < 2) return path;
  std::vector<Vector2> few;
  for (double tolerance_m = kFinest_m;; tolerance_m *= 2.0) {
    std::vector<bool> kept(path.size(), false);
    kept.front() = kept.back() = true;
    keep_between(path, 0, path.size() - 1, tolerance_m, kept);
    few.clear();
    for (std::size_t i = 0; i < path.size(); ++i) {
      if (kept[i]) few.push_back(path[i]);
    }
    if (few.size() <= most) return few;
  }
}

}  // namespace mocha
