#include "benchmarks/static_clearance.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mocha {

StaticClearance::StaticClearance(StaticGround ground, double keep_m, double cell_m)
    : ground_(std::move(ground)), keep_m_(keep_m), cell_m_(cell_m) {
  columns_ = 1 + static_cast<int>((ground_.high.x() - ground_.low.x()) / cell_m_);
  rows_ = 1 + static_cast<int>((ground_.high.y() - ground_.low.y()) / cell_m_);
  distances_m_.reserve(static_cast<std::size_t>(columns_) * rows_);
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      distances_m_.push_back(distance_m(ground_.low + cell_m_ * Vector2(column, row)));
    }
  }
}

bool StaticClearance::clear(const Vector2& place) const {
  const Vector2 cell = (place - ground_.low) / cell_m_;
  const int column = static_cast<int>(std::lround(cell.x()));
  const int row = static_cast<int>(std::lround(cell.y()));
  if (column < 0 || column >= columns_ || row < 0 || row >= rows_) return false;
  const double near_m = distances_m_[static_cast<std::size_t>(row) * columns_ + column];
  if (std::abs(near_m - keep_m_) > cell_m_) return near_m > keep_m_;
  return distance_m(place) >= keep_m_;
}

double StaticClearance::distance_m(const Vector2& place) const {
  const Vector2 inside = (place - ground_.low).cwiseMin(ground_.high - place);
  double least = inside.minCoeff();
  for (const Obstacle& obstacle : ground_.obstacles) {
    const auto to = [&](const auto& shape) { return gap(place, shape).distance_m; };
    least = std::min(least, std::visit(to, obstacle));
  }
  return least;
}

}  // namespace mocha
