#include "topology/roadmaps/obstacle_tile.h"

#include <algorithm>

namespace mocha {
namespace {

constexpr double kSlackCells = 0.5;  // of a gap: between corners, distances are interpolated
constexpr int kNone = -1;

class Builder {
 public:
  Builder(const DistanceField& field, const CornerWindow& window, double clearance_m)
      : field_(field),
        window_(window),
        least_gap_m_(2.0 * clearance_m),
        part_(static_cast<std::size_t>(window.columns()) * window.rows(), kNone) {}

  ObstacleTile run() {
    for (int y = window_.y0; y <= window_.y1; ++y) {
      for (int x = window_.x0; x <= window_.x1; ++x) {
        if (field_.at_corner(x, y) < 0.5 * least_gap_m_ && part_at(x, y) == kNone &&
            !passable(x, y, x, y))
          spread(x, y);
      }
    }
    for (int x = window_.x0; x <= window_.x1; ++x) {
      add_border(x, window_.y0);
      add_border(x, window_.y1);
    }
    for (int y = window_.y0 + 1; y < window_.y1; ++y) {
      add_border(window_.x0, y);
      add_border(window_.x1, y);
    }
    return std::move(tile_);
  }

 private:
  int& part_at(int x, int y) {
    return part_[static_cast<std::size_t>(y - window_.y0) * window_.columns() + (x - window_.x0)];
  }

  /// Whether a robot may come through between two neighbouring corners: no point between them is
  /// farther from solid matter than half of `gap_m`.
  bool passable(int x, int y, int nx, int ny) const {
    const double outside_m = field_.at_corner(x, y) + field_.at_corner(nx, ny);
    const double apart_m =
        field_.resolution_m() * ((x != nx && y != ny) ? M_SQRT2 : x != nx || y != ny);
    const double slack_m = outside_m > 0.0 ? kSlackCells * field_.resolution_m() : 0.0;
    return outside_m + apart_m >= least_gap_m_ - slack_m;
  }

  void spread(int x, int y) {
    const int number = static_cast<int>(tile_.parts.size());
    solid_.clear();
    part_at(x, y) = number;
    front_.assign(1, {x, y});
    while (!front_.empty()) {
      const auto [cx, cy] = front_.back();
      front_.pop_back();
      if (field_.at_corner(cx, cy) <= 0.0) solid_.push_back(field_.corner(cx, cy));
      for (int ny = std::max(window_.y0, cy - 1); ny <= std::min(window_.y1, cy + 1); ++ny) {
        for (int nx = std::max(window_.x0, cx - 1); nx <= std::min(window_.x1, cx + 1); ++nx) {
          if (part_at(nx, ny) != kNone || passable(cx, cy, nx, ny)) continue;
          part_at(nx, ny) = number;
          front_.push_back({nx, ny});
        }
      }
    }
    tile_.parts.push_back(part_of_solid());
  }

  ObstacleTile::Part part_of_solid() const {
    ObstacleTile::Part part;
    if (solid_.empty()) return part;
    part.solid_corners = static_cast<int>(solid_.size());
    for (const Vector2& place : solid_) part.sum += place;
    const Vector2 mean = part.sum / part.solid_corners;
    part.innermost =
        *std::min_element(solid_.begin(), solid_.end(), [&](const Vector2& a, const Vector2& b) {
          return (a - mean).squaredNorm() < (b - mean).squaredNorm();
        });
    return part;
  }

  void add_border(int x, int y) {
    if (const int part = part_at(x, y); part != kNone)
      tile_.border.push_back({y * field_.columns() + x, part});
  }

  const DistanceField& field_;
  const CornerWindow window_;
  const double least_gap_m_;
  std::vector<int> part_;
  std::vector<std::pair<int, int>> front_;
  std::vector<Vector2> solid_;  // corners of the part
  ObstacleTile tile_;
};

}  // namespace

ObstacleTile obstacle_tile(const DistanceField& field, const CornerWindow& window,
                           double clearance_m) {
  return Builder(field, window, clearance_m).run();
}

}  // namespace mocha
