#pragma once

#include <cstdint>
#include <vector>

namespace mocha {

/// Places of a grid, row by row, and how much room each has: below 0, it does not belong to the
/// figure.
struct RoomRaster {
  int columns;
  int rows;
  std::vector<float> room;  ///< columns * rows values
};

/// Which places remain when a figure is thinned: as few as can be while its pieces (of eight
/// neighbours each) and its holes stay what they are, and while the `anchors` stay (numbers of
/// places of the figure). What has least room goes first, so the rest runs midway between what is
/// around the figure. Ends that are no anchors go. Distance-ordered homotopic thinning (Pudney
/// 1998).
///
/// A value for each place, 1 where it remains.
std::vector<std::uint8_t> thinned(const RoomRaster& figure, const std::vector<int>& anchors);

}  // namespace mocha
