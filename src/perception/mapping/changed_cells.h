#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "world/corner_window.h"

namespace mocha {

/// Where cells of a map have changed, as few rectangles with little else in them.
class ChangedCells {
 public:
  void add(int x, int y);

  /// Rectangles of cells, both ends included, that hold all cells added; those are forgotten.
  std::vector<CornerWindow> take();

 private:
  std::unordered_map<std::uint64_t, CornerWindow> tiles_;  // what has changed of each
  std::uint64_t last_key_ = 0;
  CornerWindow* last_ = nullptr;  // the tile of the last cell: the next is often there, too
};

}  // namespace mocha
