#include "planning/passing/obstacles_along.h"

#include <algorithm>
#include <cmath>

namespace mocha {
namespace {

constexpr double kSpacing_m = 0.1;  // of where is looked, and of what is found
constexpr double kClearly_m = 0.05;

}  // namespace

std::vector<Vector2> obstacles_along(const std::vector<Vector2>& path, const StaticMap& static_map,
                                     double clearance_m) {
  const ObstacleField<2>& field = static_map.field();
  const double keep_m = std::min(clearance_m, field.sample(path.front()).distance_m) - kClearly_m;
  std::vector<Vector2> obstacles;
  const auto look = [&](const Vector2& place) {
    const auto nearest = field.sample(place);
    if (!(nearest.distance_m < keep_m)) return;
    const Vector2 obstacle = place - std::max(nearest.distance_m, 0.0) * nearest.gradient;
    const bool is_known =
        std::any_of(obstacles.begin(), obstacles.end(),
                    [&](const Vector2& other) { return (other - obstacle).norm() < kSpacing_m; });
    if (!is_known) obstacles.push_back(obstacle);
  };
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vector2 step = path[i] - path[i - 1];
    const int parts = std::max(1, static_cast<int>(std::ceil(step.norm() / kSpacing_m)));
    for (int part = 1; part <= parts; ++part)
      look(path[i - 1] + static_cast<double>(part) / parts * step);
  }
  return obstacles;
}

}  // namespace mocha
