#include "perception/localization/square_sums.h"

#include <algorithm>

namespace mocha {
namespace {

struct Split {
  int square;
  int offset;
};

/// Also left of and below the grid.
Split split(int cell, int edge) {
  const int offset = ((cell % edge) + edge) % edge;
  return {(cell - offset) / edge, offset};
}

}  // namespace

// The planes have a square before the grid: squares that begin there reach into it.
SquareSums::SquareSums(const GridPyramid& pyramid, int level)
    : edge_(1 << level),
      columns_((pyramid.width() + edge_ - 1) / edge_),
      rows_((pyramid.height() + edge_ - 1) / edge_),
      plane_columns_(columns_ + 1),
      plane_rows_(rows_ + 1) {
  planes_.reserve(static_cast<std::size_t>(edge_) * edge_ * plane_columns_ * plane_rows_);
  for (int y = 0; y < edge_; ++y) {
    for (int x = 0; x < edge_; ++x) {
      for (int row = -1; row < rows_; ++row) {
        for (int column = -1; column < columns_; ++column)
          planes_.push_back(pyramid.at(level, column * edge_ + x, row * edge_ + y));
      }
    }
  }
}

SquareSums::Part SquareSums::part(const Cell& low, const Cell& high) const {
  const auto within = [&](int cell, int squares) {
    return std::clamp(split(cell, edge_).square, 0, squares - 1);
  };
  return {{within(low[0], columns_), within(low[1], rows_)},
          {within(high[0], columns_) + 1, within(high[1], rows_) + 1}};
}

void SquareSums::add_up(const std::vector<Cell>& pattern, const Part& part,
                        std::vector<std::uint16_t>& sums) const {
  sums.assign(part.squares(), 0);
  for (const Cell& cell : pattern) add(cell, part, sums.data());
}

void SquareSums::add(const Cell& cell, const Part& part, std::uint16_t* sums) const {
  const Split x = split(cell[0], edge_);
  const Split y = split(cell[1], edge_);
  const std::size_t plane = static_cast<std::size_t>(y.offset) * edge_ + x.offset;
  const std::uint8_t* values = planes_.data() + plane * plane_columns_ * plane_rows_;
  const int begin = std::max(part.begin[0], -1 - x.square);
  const int end = std::min(part.end[0], columns_ - x.square);
  const int last_row = std::min(part.end[1], rows_ - y.square);
  for (int row = std::max(part.begin[1], -1 - y.square); row < last_row; ++row) {
    const std::uint8_t* from =
        values + static_cast<std::ptrdiff_t>(row + y.square + 1) * plane_columns_ + x.square + 1;
    std::uint16_t* to =
        sums + static_cast<std::ptrdiff_t>(row - part.begin[1]) * part.columns() - part.begin[0];
    for (int column = begin; column < end; ++column)
      to[column] = static_cast<std::uint16_t>(to[column] + from[column]);
  }
}

}  // namespace mocha
