#pragma once

#include <vector>

#include "world/obstacle.h"

namespace mocha {

/// Static obstacles sorted into square cells, for casting many rays.
class RayGrid {
 public:
  RayGrid(const std::vector<Circle>& circles, const std::vector<Polygon>& polygons);

  /// From `origin` along the unit vector `direction` to the nearest rim [m]; infinity if there is
  /// none within `max_length_m`.
  double ray_length(const Vector2& origin, const Vector2& direction, double max_length_m) const;

 private:
  struct Segment {
    Vector2 a;
    Vector2 b;
  };
  struct Cell {
    std::vector<Circle> circles;
    std::vector<Segment> segments;
  };

  Cell& cell(int x, int y) { return cells_[static_cast<std::size_t>(y) * columns_ + x]; }
  const Cell& cell(int x, int y) const {
    return cells_[static_cast<std::size_t>(y) * columns_ + x];
  }
  int index(double offset_m, int count) const;
  void add(const Circle& circle);
  void add(const Segment& segment);
  static double nearest_in(const Cell& cell, const Vector2& origin, const Vector2& direction);

  double cell_m_ = 1.0;
  Vector2 origin_ = Vector2::Zero();
  int columns_ = 0;
  int rows_ = 0;
  std::vector<Cell> cells_;
};

}  // namespace mocha
