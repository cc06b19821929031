#include "world/distances/window_joining.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace mocha {
namespace {

TEST(WindowJoining, NeighboursBecomeOneAndWhatIsFarApartDoesNot) {
  const CornerWindow left{0, 0, 9, 9};
  const CornerWindow right{10, 0, 19, 9};
  const CornerWindow far{500, 500, 501, 501};
  const auto windows = joined({far, right, left}, 20);
  ASSERT_EQ(windows.size(), 2u);
  EXPECT_EQ(windows[0], (CornerWindow{0, 0, 19, 9}));
  EXPECT_EQ(windows[1], far);
  EXPECT_EQ(joined({far, left}, 600).size(), 1u) << "another one costs more than what is between";
  EXPECT_TRUE(joined({}, 20).empty());
}

TEST(WindowJoining, NothingIsLostAndNothingBecomesLarger) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<CornerWindow> windows;
    for (int i = 0; i < 60; ++i) {
      const int x = static_cast<int>(random() % 400) - 200;
      const int y = static_cast<int>(random() % 400) - 200;
      windows.push_back({x, y, x + static_cast<int>(random() % 9), y});
    }
    const auto size = [](const std::vector<CornerWindow>& all) {
      double cells = 0.0;
      for (const CornerWindow& window : all)
        cells += static_cast<double>(window.columns() + 20) * (window.rows() + 20);
      return cells;
    };
    const auto fewer = joined(windows, 10);
    EXPECT_LE(size(fewer), size(windows));
    for (const CornerWindow& window : windows) {
      EXPECT_TRUE(std::any_of(fewer.begin(), fewer.end(), [&](const CornerWindow& other) {
        return window.within(other) == window;
      }));
    }
  }
}

}  // namespace
}  // namespace mocha
