#include "simulation/ray_grid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace mocha {
namespace {

constexpr double kNoHit_m = std::numeric_limits<double>::infinity();
constexpr double kSmallestCell_m = 0.5;
constexpr double kMostCells = 500.0;  // along one axis: wider worlds get larger cells
constexpr double kRounding_m = 1e-9;

/// Walks along one axis of the grid: at which length of the ray the next cell begins.
struct Axis {
  int cell;
  int step;
  double next;
  double width;  ///< ray length across one cell

  Axis(double from, double direction, int start, double cell_m)
      : cell(start), step(direction > 0.0 ? 1 : -1) {
    const double edge = (start + (step > 0 ? 1 : 0)) * cell_m;
    next = direction == 0.0 ? kNoHit_m : (edge - from) / direction;
    width = direction == 0.0 ? kNoHit_m : cell_m / std::abs(direction);
  }
};

/// The part of a ray inside the box [0, size]; false where it misses.
bool clip(const Vector2& from, const Vector2& direction, const Vector2& size, double& begin,
          double& end) {
  for (int i = 0; i < 2; ++i) {
    if (direction[i] == 0.0) {
      if (from[i] < 0.0 || from[i] > size[i]) return false;
      continue;
    }
    const double a = -from[i] / direction[i];
    const double b = (size[i] - from[i]) / direction[i];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  return begin <= end;
}

}  // namespace

RayGrid::RayGrid(const std::vector<Circle>& circles, const std::vector<Polygon>& polygons) {
  Eigen::AlignedBox2d bounds;
  for (const Circle& circle : circles) {
    bounds.extend(Vector2(circle.centre.array() - circle.radius_m));
    bounds.extend(Vector2(circle.centre.array() + circle.radius_m));
  }
  for (const Polygon& polygon : polygons) {
    for (const Vector2& corner : polygon.corners) bounds.extend(corner);
  }
  if (bounds.isEmpty()) return;
  cell_m_ = std::max(kSmallestCell_m, bounds.sizes().maxCoeff() / kMostCells);
  origin_ = bounds.min() - Vector2::Constant(kRounding_m);
  columns_ = 1 + static_cast<int>((bounds.max().x() - origin_.x() + kRounding_m) / cell_m_);
  rows_ = 1 + static_cast<int>((bounds.max().y() - origin_.y() + kRounding_m) / cell_m_);
  cells_.resize(static_cast<std::size_t>(columns_) * rows_);
  for (const Circle& circle : circles) add(circle);
  for (const Polygon& polygon : polygons) {
    for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
      add(Segment{polygon.corners[i], polygon.corners[(i + 1) % polygon.corners.size()]});
    }
  }
}

int RayGrid::index(double offset_m, int count) const {
  return std::clamp(static_cast<int>(std::floor(offset_m / cell_m_)), 0, count - 1);
}

void RayGrid::add(const Circle& circle) {
  const Vector2 low = circle.centre - origin_ - Vector2::Constant(circle.radius_m + kRounding_m);
  const Vector2 high = circle.centre - origin_ + Vector2::Constant(circle.radius_m + kRounding_m);
  for (int y = index(low.y(), rows_); y <= index(high.y(), rows_); ++y) {
    for (int x = index(low.x(), columns_); x <= index(high.x(), columns_); ++x) {
      cell(x, y).circles.push_back(circle);
    }
  }
}

void RayGrid::add(const Segment& segment) {
  const Vector2 a = segment.a - origin_;
  const Vector2 b = segment.b - origin_;
  const int first_row = index(std::min(a.y(), b.y()) - kRounding_m, rows_);
  const int last_row = index(std::max(a.y(), b.y()) + kRounding_m, rows_);
  for (int y = first_row; y <= last_row; ++y) {
    // The part of the segment that lies in this row of cells.
    double from = 0.0;
    double to = 1.0;
    if (a.y() != b.y()) {
      const double at_bottom = (y * cell_m_ - a.y()) / (b.y() - a.y());
      const double at_top = ((y + 1) * cell_m_ - a.y()) / (b.y() - a.y());
      from = std::clamp(std::min(at_bottom, at_top), 0.0, 1.0);
      to = std::clamp(std::max(at_bottom, at_top), 0.0, 1.0);
    }
    const double x0 = a.x() + from * (b.x() - a.x());
    const double x1 = a.x() + to * (b.x() - a.x());
    const int last = index(std::max(x0, x1) + kRounding_m, columns_);
    for (int x = index(std::min(x0, x1) - kRounding_m, columns_); x <= last; ++x) {
      cell(x, y).segments.push_back(segment);
    }
  }
}

double RayGrid::nearest_in(const Cell& cell, const Vector2& origin, const Vector2& direction) {
  double length = kNoHit_m;
  for (const Circle& circle : cell.circles) {
    length = std::min(length, mocha::ray_length(origin, direction, circle));
  }
  for (const Segment& segment : cell.segments) {
    length = std::min(length, mocha::ray_length(origin, direction, segment.a, segment.b));
  }
  return length;
}

double RayGrid::ray_length(const Vector2& origin, const Vector2& direction,
                           double max_length_m) const {
  const Vector2 from = origin - origin_;
  double begin = 0.0;
  double end = max_length_m;
  if (cells_.empty() || !clip(from, direction, cell_m_ * Vector2(columns_, rows_), begin, end)) {
    return kNoHit_m;
  }
  const Vector2 entry = from + begin * direction;
  Axis x(from.x(), direction.x(), index(entry.x(), columns_), cell_m_);
  Axis y(from.y(), direction.y(), index(entry.y(), rows_), cell_m_);
  double nearest = kNoHit_m;
  while (x.cell >= 0 && x.cell < columns_ && y.cell >= 0 && y.cell < rows_) {
    nearest = std::min(nearest, nearest_in(cell(x.cell, y.cell), origin, direction));
    const double leaves = std::min(x.next, y.next);
    if (nearest <= leaves || leaves > end) break;
    Axis& crossed = x.next < y.next ? x : y;
    crossed.cell += crossed.step;
    crossed.next += crossed.width;
  }
  return nearest <= max_length_m ? nearest : kNoHit_m;
}

}  // namespace mocha
