#pragma once

#include <algorithm>
#include <cmath>

#include "topology/static_map/travel_cost.h"

namespace mocha {

/// The places of a square lattice over a static map's bounds, that holds the corners of its cells;
/// numbered row by row.
class Lattice {
 public:
  /// Places are about `step_m` apart, but never finer than the static map's detail.
  Lattice(const StaticMap& static_map, double step_m) : origin_(static_map.bounds().min()) {
    constexpr double kRounding = 1e-6;
    const double finest_m = 2.0 * static_map.detail_m();
    step_m_ = finest_m * std::max(1.0, std::round(step_m / finest_m));
    const Vector2 steps = static_map.bounds().sizes() / step_m_;
    columns_ = static_cast<int>(steps.x() + kRounding) + 1;
    rows_ = static_cast<int>(steps.y() + kRounding) + 1;
  }

  std::size_t size() const { return static_cast<std::size_t>(columns_) * rows_; }
  double step_m() const { return step_m_; }
  int column(int node) const { return node % columns_; }
  int row(int node) const { return node / columns_; }
  Vector2 position(int node) const { return origin_ + step_m_ * Vector2(column(node), row(node)); }

  /// One of the four corners (0 to 3) of the square that holds p, inside of the bounds.
  int corner(const Vector2& p, int which) const {
    const Vector2 at = (p - origin_) / step_m_;
    const int x = std::clamp(static_cast<int>(at.x()) + which % 2, 0, columns_ - 1);
    const int y = std::clamp(static_cast<int>(at.y()) + which / 2, 0, rows_ - 1);
    return y * columns_ + x;
  }

  /// That corner of the square that holds p to which the straight line is cheapest; -1 if all are
  /// blocked.
  int entry(const Vector2& p, const TravelCost& cost) const {
    int best = -1;
    double least = TravelCost::kInfinity;
    for (int which = 0; which < 4; ++which) {
      const int node = corner(p, which);
      const double cost_m = cost.of_line(p, position(node));
      if (!(cost_m < least)) continue;
      least = cost_m;
      best = node;
    }
    return best;
  }

  int nearest(const Vector2& p) const {
    const Vector2 at = (p - origin_) / step_m_;
    const int x = std::clamp(static_cast<int>(std::lround(at.x())), 0, columns_ - 1);
    const int y = std::clamp(static_cast<int>(std::lround(at.y())), 0, rows_ - 1);
    return y * columns_ + x;
  }

  /// Calls visit(neighbour, length [m]) for up to eight.
  template <typename Visit>
  void visit_neighbours(int node, const Visit& visit) const {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = column(node) + dx;
        const int y = row(node) + dy;
        if ((dx == 0 && dy == 0) || x < 0 || y < 0 || x >= columns_ || y >= rows_) continue;
        visit(y * columns_ + x, step_m_ * (dx != 0 && dy != 0 ? M_SQRT2 : 1.0));
      }
    }
  }

 private:
  Vector2 origin_;
  double step_m_;
  int columns_;
  int rows_;
};

}  // namespace mocha
