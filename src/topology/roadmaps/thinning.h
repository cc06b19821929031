#pragma once

#include <array>
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

/// Thins one figure after the other, in the same memory: as few places remain as can be while the
/// pieces of the figure (of eight neighbours each) and its holes stay what they are. What has least
/// room goes first, so the rest runs midway between what is around the figure. Distance-ordered
/// homotopic thinning (Pudney 1998).
class Thinning {
 public:
  /// `anchors`: numbers of places of the figure that remain in any case; other ends go. Returns a
  /// value for each place, 1 where it remains.
  std::vector<std::uint8_t> run(const RoomRaster& figure, const std::vector<int>& anchors);

 private:
  static constexpr int kBuckets = 256;

  void start(const RoomRaster& figure, const std::vector<int>& anchors);
  /// Queues a place that may go.
  void push(int place);
  /// First come, first served among those of equal room; -1 at the end.
  int pop();

  // Places of the figure with a margin around that does not belong to it.
  int stride_ = 0;
  std::array<int, 8> around_{};
  std::vector<std::uint8_t> state_;
  std::vector<std::uint8_t> around_it_;  // which neighbours are there; bits as in `around_`
  std::vector<std::uint8_t> bucket_;
  // The queue: places of equal room in a row.
  std::array<int, kBuckets> first_{};
  std::array<int, kBuckets> last_{};
  std::vector<int> next_;
  int lowest_ = kBuckets;
};

}  // namespace mocha
