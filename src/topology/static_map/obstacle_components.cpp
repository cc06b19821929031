#include "topology/static_map/obstacle_components.h"

#include <algorithm>
#include <cmath>

namespace mocha {
namespace {

constexpr double kSlackCells = 0.5;  // of a gap: between corners, distances are interpolated

}  // namespace

ObstacleComponents::ObstacleComponents(const DistanceField& field, const CornerWindow& window,
                                       double clearance_m, Kind kind)
    : field_(field),
      window_(window),
      least_gap_m_(2.0 * clearance_m),
      number_(static_cast<std::size_t>(window.columns()) * window.rows(), kNone) {
  for (int y = window.y0; y <= window.y1; ++y) {
    for (int x = window.x0; x <= window.x1; ++x) {
      // Whatever begins one has no more room than that.
      if (field.at_corner(x, y) > 0.5 * least_gap_m_ || at(x, y) != kNone) continue;
      const bool begins =
          kind == Kind::kSolid ? field.at_corner(x, y) <= 0.0 : !passable(x, y, x, y);
      if (begins) flood(x, y);
    }
  }
}

/// Whether a robot may come through between two neighbouring corners: no point between them is
/// farther from solid matter than half of the gap.
bool ObstacleComponents::passable(int x, int y, int nx, int ny) const {
  const double outside_m = field_.at_corner(x, y) + field_.at_corner(nx, ny);
  const double apart_m =
      field_.resolution_m() * ((x != nx && y != ny) ? M_SQRT2 : x != nx || y != ny);
  const double slack_m = outside_m > 0.0 ? kSlackCells * field_.resolution_m() : 0.0;
  return outside_m + apart_m >= least_gap_m_ - slack_m;
}

void ObstacleComponents::flood(int x, int y) {
  const int number = size();
  std::vector<Vector2>& solid = solid_.emplace_back();
  number_[index(x, y)] = number;
  front_.assign(1, {x, y});
  while (!front_.empty()) {
    const auto [cx, cy] = front_.back();
    front_.pop_back();
    if (field_.at_corner(cx, cy) <= 0.0) solid.push_back(field_.corner(cx, cy));
    for (int ny = std::max(window_.y0, cy - 1); ny <= std::min(window_.y1, cy + 1); ++ny) {
      for (int nx = std::max(window_.x0, cx - 1); nx <= std::min(window_.x1, cx + 1); ++nx) {
        if (at(nx, ny) != kNone || passable(cx, cy, nx, ny)) continue;
        number_[index(nx, ny)] = number;
        front_.push_back({nx, ny});
      }
    }
  }
}

const Vector2& nearest_to(const Vector2& place, const std::vector<Vector2>& points) {
  return *std::min_element(points.begin(), points.end(), [&](const Vector2& a, const Vector2& b) {
    return (a - place).squaredNorm() < (b - place).squaredNorm();
  });
}

}  // namespace mocha
