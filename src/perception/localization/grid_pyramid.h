#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mocha {

/// A grid of values and, for each level k, the greatest value of every square of 2^k by 2^k cells:
/// bounds for searches that go from coarse to fine (Olson 2009; Hess et al. 2016). Outside the grid
/// all values are 0.
class GridPyramid {
 public:
  /// `values` row by row, width * height of them; levels 0 to `top`.
  GridPyramid(std::vector<std::uint8_t> values, int width, int height, int top);

  /// The greatest value of the cells x <= i < x + 2^level, y <= j < y + 2^level.
  std::uint8_t at(int level, int x, int y) const {
    // Squares that begin left of or below the grid are kept as well, as far as they reach it.
    const int before = (1 << level) - 1;
    const int column = x + before;
    const int row = y + before;
    const int columns = width_ + before;
    if (column < 0 || row < 0 || column >= columns || row >= height_ + before) return 0;
    return levels_[level][static_cast<std::size_t>(row) * columns + column];
  }

  int width() const { return width_; }
  int height() const { return height_; }
  int top() const { return static_cast<int>(levels_.size()) - 1; }

 private:
  int width_;
  int height_;
  std::vector<std::vector<std::uint8_t>> levels_;
};

}  // namespace mocha
