#include "perception/localization/grid_pyramid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace mocha {
namespace {

TEST(GridPyramidTest, EveryLevelHoldsTheGreatestValueOfItsSquares) {
  constexpr int kWidth = 23;
  constexpr int kHeight = 17;
  std::mt19937 random(1);
  std::vector<std::uint8_t> values(kWidth * kHeight);
  for (std::uint8_t& value : values) value = static_cast<std::uint8_t>(random() % 256);
  const GridPyramid pyramid(values, kWidth, kHeight, 5);
  const auto value_at = [&](int x, int y) -> std::uint8_t {
    const bool inside = x >= 0 && y >= 0 && x < kWidth && y < kHeight;
    return inside ? values[static_cast<std::size_t>(y) * kWidth + x] : 0;
  };
  for (int level = 0; level <= 5; ++level) {
    const int edge = 1 << level;
    for (int y = -40; y < kHeight + 5; ++y) {
      for (int x = -40; x < kWidth + 5; ++x) {
        std::uint8_t greatest = 0;
        for (int v = y; v < y + edge; ++v) {
          for (int u = x; u < x + edge; ++u) greatest = std::max(greatest, value_at(u, v));
        }
        ASSERT_EQ(pyramid.at(level, x, y), greatest) << level << ' ' << x << ' ' << y;
      }
    }
  }
}

}  // namespace
}  // namespace mocha
