#pragma once

namespace mocha {

/// Corners of a map's cells, both ends included: tiles that are neighbours share a row or a column.
struct CornerWindow {
  int x0, y0, x1, y1;

  int columns() const { return x1 - x0 + 1; }
  int rows() const { return y1 - y0 + 1; }
};

}  // namespace mocha
