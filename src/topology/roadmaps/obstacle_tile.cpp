#include "topology/roadmaps/obstacle_tile.h"

#include "topology/static_map/obstacle_components.h"

namespace mocha {
namespace {

ObstacleTile::Part part_of(const std::vector<Vector2>& solid) {
  ObstacleTile::Part part;
  if (solid.empty()) return part;
  part.solid_corners = static_cast<int>(solid.size());
  for (const Vector2& place : solid) part.sum += place;
  part.innermost = nearest_to(part.sum / part.solid_corners, solid);
  return part;
}

}  // namespace

ObstacleTile obstacle_tile(const DistanceField& field, const CornerWindow& window,
                           double clearance_m) {
  const ObstacleComponents components(field, window, clearance_m, ObstacleComponents::Kind::kAny);
  ObstacleTile tile;
  for (int i = 0; i < components.size(); ++i) tile.parts.push_back(part_of(components.solid(i)));
  const auto add_border = [&](int x, int y) {
    if (const int part = components.at(x, y); part != ObstacleComponents::kNone)
      tile.border.push_back({y * field.columns() + x, part});
  };
  for (int x = window.x0; x <= window.x1; ++x) {
    add_border(x, window.y0);
    add_border(x, window.y1);
  }
  for (int y = window.y0 + 1; y < window.y1; ++y) {
    add_border(window.x0, y);
    add_border(window.x1, y);
  }
  return tile;
}

}  // namespace mocha
