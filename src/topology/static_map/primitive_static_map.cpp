#include "topology/static_map/primitive_static_map.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "topology/static_map/union_find.h"
#include "world/primitive.h"

namespace mocha {
namespace {

constexpr double kDetail_m = 0.1;

/// Which obstacles belong together.
UnionFind impassable(const std::vector<Obstacle>& obstacles, double clearance_m) {
  const int count = static_cast<int>(obstacles.size());
  UnionFind sets(count);
  std::vector<Eigen::AlignedBox2d> boxes;
  for (const Obstacle& obstacle : obstacles) boxes.push_back(extent(obstacle));
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < i; ++j) {
      if (boxes[i].exteriorDistance(boxes[j]) >= 2.0 * clearance_m) continue;
      if (gap(obstacles[i], obstacles[j]).distance_m < 2.0 * clearance_m) sets.join(i, j);
    }
  }
  return sets;
}

Vector2 point_of(const Circle& circle) { return circle.centre; }
Vector2 point_of(const Polygon& polygon) { return polygon.corners.front(); }

void cover(const Circle& circle, double, std::vector<Circle>& circles) {
  circles.push_back(circle);
}

void cover(const Polygon& polygon, double spacing_m, std::vector<Circle>& circles) {
  for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
    const Vector2& from = polygon.corners[i];
    const Vector2 side = polygon.corners[(i + 1) % polygon.corners.size()] - from;
    const int parts = 1 + static_cast<int>(side.norm() / spacing_m);
    for (int k = 0; k < parts; ++k) circles.push_back({from + side * k / parts, 0.0});
  }
}

}  // namespace

PrimitiveStaticMap::PrimitiveStaticMap(std::shared_ptr<const PrimitiveField<2>> field,
                                       const Eigen::AlignedBox2d& bounds)
    : field_(std::move(field)), bounds_(bounds) {}

double PrimitiveStaticMap::detail_m() const { return kDetail_m; }

std::vector<ObstacleGroup> PrimitiveStaticMap::groups_within(const Eigen::AlignedBox2d& window,
                                                             double clearance_m) const {
  std::vector<Obstacle> obstacles;
  std::copy_if(field_->primitives().begin(), field_->primitives().end(),
               std::back_inserter(obstacles),
               [&](const Obstacle& obstacle) { return extent(obstacle).intersects(window); });
  UnionFind sets = impassable(obstacles, clearance_m);
  std::vector<ObstacleGroup> groups;
  std::vector<std::size_t> group_of(obstacles.size());
  for (int i = 0; i < static_cast<int>(obstacles.size()); ++i) {
    const int first = sets.root(i);
    if (first == i) {
      group_of[i] = groups.size();
      groups.emplace_back();
      groups.back().representative =
          std::visit([](const auto& shape) { return point_of(shape); }, obstacles[i]);
    }
    auto& circles = groups[group_of[first]].cover;
    std::visit([&](const auto& shape) { cover(shape, clearance_m, circles); }, obstacles[i]);
  }
  return groups;
}

}  // namespace mocha
