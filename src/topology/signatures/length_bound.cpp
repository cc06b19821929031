#include "topology/signatures/length_bound.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "trajectory/plane_vectors.h"

namespace mocha {
namespace {

using Vector2 = Eigen::Vector2d;

constexpr int kProjections = 4;        // onto what is nearest
constexpr double kOnSurface_m = 1e-6;  // no path comes as close

struct Ray {
  Vector2 origin;
  Vector2 direction;  // unit

  double side_m(const Vector2& p) const { return cross(direction, p - origin); }
  double along_m(const Vector2& p) const { return direction.dot(p - origin); }
};

/// From the obstacle nearest to p through p; nothing where it cannot be made out, as midway between
/// obstacles. Only a ray that begins on solid matter is crossed by all paths of a class alike.
std::optional<Ray> ray_through(const Vector2& p, const ObstacleField<2>& field) {
  Vector2 origin = p;
  auto nearest = field.sample(origin);
  if (!(nearest.distance_m > kOnSurface_m)) return std::nullopt;
  for (int i = 0; i < kProjections && nearest.distance_m > kOnSurface_m; ++i) {
    origin -= nearest.distance_m * nearest.gradient.normalized();
    nearest = field.sample(origin);
  }
  if (!(nearest.distance_m <= kOnSurface_m)) return std::nullopt;
  return Ray{origin, (p - origin).normalized()};
}

/// How often the path crosses the ray from right to left, minus how often from left to right.
int net_crossings(const std::vector<Vector2>& path, const Ray& ray) {
  int crossings = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double before = ray.side_m(path[i - 1]);
    const double after = ray.side_m(path[i]);
    if ((before >= 0.0) == (after >= 0.0)) continue;
    const Vector2 place = path[i - 1] + (path[i] - path[i - 1]) * (before / (before - after));
    if (ray.along_m(place) >= 0.0) crossings += after >= 0.0 ? 1 : -1;
  }
  return crossings;
}

/// Length of the shortest path from a to b by way of the ray.
double by_way_of(const Ray& ray, const Vector2& a, const Vector2& b) {
  const double a_off = std::abs(ray.side_m(a));
  const double b_off = std::abs(ray.side_m(b));
  const double a_along = ray.along_m(a);
  const double b_along = ray.along_m(b);
  // Straight after folding both ends to opposite sides; convex along the ray, so a best place
  // before its origin is replaced by the origin.
  const double total = a_off + b_off;
  const double best =
      total > 0.0 ? a_along + (b_along - a_along) * a_off / total : std::max(a_along, b_along);
  const Vector2 place = ray.origin + std::max(0.0, best) * ray.direction;
  return (a - place).norm() + (b - place).norm();
}

}  // namespace

double least_length_m(const std::vector<Vector2>& path, const ObstacleField<2>& field) {
  const Vector2& start = path.front();
  const Vector2& goal = path.back();
  double least_m = (goal - start).norm();
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const auto ray = ray_through(path[i], field);
    if (ray && net_crossings(path, *ray) != 0)
      least_m = std::max(least_m, by_way_of(*ray, start, goal));
  }
  return least_m;
}

}  // namespace mocha
