#include "perception/localization/square_sums.h"

#include <gtest/gtest.h>

#include <random>

namespace mocha {
namespace {

TEST(SquareSumsTest, AreThoseOfThePyramid) {
  constexpr int kLevel = 3;
  constexpr int kWidth = 53;
  constexpr int kHeight = 38;
  std::mt19937 random(1);
  std::vector<std::uint8_t> values(kWidth * kHeight);
  for (auto& value : values) value = random() % 20 == 0 ? random() % 256 : 0;
  const GridPyramid pyramid(values, kWidth, kHeight, kLevel);
  const SquareSums squares(pyramid, kLevel);
  std::vector<SquareSums::Cell> pattern;
  for (int i = 0; i < 257; ++i)
    pattern.push_back(
        {static_cast<int>(random() % 141) - 70, static_cast<int>(random() % 101) - 50});
  for (const auto& [low, high] : {std::pair<SquareSums::Cell, SquareSums::Cell>{{0, 0}, {52, 37}},
                                  {{17, 9}, {30, 30}},
                                  {{-900, -900}, {900, 900}},
                                  {{60, 20}, {70, 25}}}) {
    const SquareSums::Part part = squares.part(low, high);
    std::vector<std::uint16_t> sums;
    squares.add_up(pattern, part, sums);
    ASSERT_EQ(static_cast<int>(sums.size()), part.squares());
    ASSERT_GT(part.squares(), 0);
    std::size_t i = 0;
    for (int row = part.begin[1]; row < part.end[1]; ++row) {
      for (int column = part.begin[0]; column < part.end[0]; ++column) {
        int sum = 0;
        for (const auto& cell : pattern)
          sum += pyramid.at(kLevel, (column << kLevel) + cell[0], (row << kLevel) + cell[1]);
        EXPECT_EQ(sums[i++], sum) << column << ' ' << row;
      }
    }
  }
}

TEST(SquareSumsTest, APartHoldsTheSquaresOfItsCells) {
  const SquareSums squares(GridPyramid(std::vector<std::uint8_t>(40 * 20, 1), 40, 20, 2), 2);
  const SquareSums::Part part = squares.part({5, 3}, {13, 8});
  EXPECT_EQ(part.begin, (SquareSums::Cell{1, 0}));
  EXPECT_EQ(part.end, (SquareSums::Cell{4, 3}));
  EXPECT_EQ(squares.part({-9, -9}, {99, 99}).squares(), 10 * 5);
}

}  // namespace
}  // namespace mocha
