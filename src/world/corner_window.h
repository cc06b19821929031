#pragma once

#include <algorithm>

namespace mocha {

/// Corners of a map's cells, both ends included: windows side by side share a row or a column. Or
/// its cells, where that is said.
struct CornerWindow {
  int x0, y0, x1, y1;

  int columns() const { return x1 - x0 + 1; }
  int rows() const { return y1 - y0 + 1; }
  bool operator==(const CornerWindow& other) const {
    return x0 == other.x0 && y0 == other.y0 && x1 == other.x1 && y1 == other.y1;
  }
  bool empty() const { return x1 < x0 || y1 < y0; }
  bool holds(int x, int y) const { return x >= x0 && x <= x1 && y >= y0 && y <= y1; }
  bool meets(const CornerWindow& other) const {
    return x0 <= other.x1 && other.x0 <= x1 && y0 <= other.y1 && other.y0 <= y1;
  }
  CornerWindow grown(int margin) const {
    return {x0 - margin, y0 - margin, x1 + margin, y1 + margin};
  }
  CornerWindow within(const CornerWindow& other) const {
    return {std::max(x0, other.x0), std::max(y0, other.y0), std::min(x1, other.x1),
            std::min(y1, other.y1)};
  }
  /// The smallest that holds both; what is empty counts for nothing.
  CornerWindow united(const CornerWindow& other) const {
    if (empty()) return other;
    if (other.empty()) return *this;
    return {std::min(x0, other.x0), std::min(y0, other.y0), std::max(x1, other.x1),
            std::max(y1, other.y1)};
  }
};

}  // namespace mocha
