#include "perception/localization/grid_pyramid.h"

#include <algorithm>
#include <utility>

namespace mocha {

GridPyramid::GridPyramid(std::vector<std::uint8_t> values, int width, int height, int top)
    : width_(width), height_(height) {
  levels_.reserve(top + 1);
  levels_.push_back(std::move(values));
  for (int level = 1; level <= top; ++level) {
    const int half = 1 << (level - 1);
    const int before = (1 << level) - 1;
    const int columns = width + before;
    const int rows = height + before;
    std::vector<std::uint8_t> greatest(static_cast<std::size_t>(columns) * rows);
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const int x = column - before;
        const int y = row - before;
        greatest[static_cast<std::size_t>(row) * columns + column] =
            std::max({at(level - 1, x, y), at(level - 1, x + half, y), at(level - 1, x, y + half),
                      at(level - 1, x + half, y + half)});
      }
    }
    levels_.push_back(std::move(greatest));
  }
}

}  // namespace mocha
