#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "perception/localization/grid_pyramid.h"

namespace mocha {

/// The sums of a level of a pyramid over a pattern of cells, for all places of the pattern that are
/// a square's edge apart at once: the beginning of a search from coarse to fine. The level is kept
/// as one plane for each offset within a square (polyphase), so that neighbours' values lie side by
/// side.
class SquareSums {
 public:
  using Cell = std::array<int, 2>;

  SquareSums(const GridPyramid& pyramid, int level);

  /// Squares: columns begin <= i < end, rows likewise.
  struct Part {
    Cell begin;
    Cell end;
    int columns() const { return end[0] - begin[0]; }
    int squares() const { return columns() * (end[1] - begin[1]); }
  };

  /// The squares that hold the cells from `low` to `high`.
  Part part(const Cell& low, const Cell& high) const;

  /// Makes `sums`, row by row, those of pyramid.at(level, column * edge + x, row * edge + y) over
  /// all (x, y) of `pattern`, which has at most 257 cells, for the squares of a part.
  void add_up(const std::vector<Cell>& pattern, const Part& part,
              std::vector<std::uint16_t>& sums) const;

 private:
  void add(const Cell& cell, const Part& part, std::uint16_t* sums) const;

  int edge_;
  int columns_;
  int rows_;
  int plane_columns_;
  int plane_rows_;
  std::vector<std::uint8_t> planes_;  // plane by plane, each row by row
};

}  // namespace mocha
