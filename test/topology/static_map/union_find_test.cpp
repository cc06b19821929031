#include "topology/static_map/union_find.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace mocha {
namespace {

TEST(UnionFind, AtFirstEachIsAlone) {
  UnionFind sets(3);
  sets.add();
  ASSERT_EQ(sets.size(), 4);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(sets.root(i), i);
}

TEST(UnionFind, TheSmallestStandsForAll) {
  UnionFind sets(6);
  sets.join(4, 5);
  sets.join(5, 2);
  EXPECT_EQ(sets.root(4), 2);
  sets.join(1, 4);
  sets.join(4, 1);
  for (const int i : {1, 2, 4, 5}) EXPECT_EQ(sets.root(i), 1);
  EXPECT_EQ(sets.root(0), 0);
  EXPECT_EQ(sets.root(3), 3);
}

TEST(UnionFind, AgreesWithLabelsThatAreReplacedOneByOne) {
  constexpr int kCount = 60;
  std::mt19937 random(1);
  std::uniform_int_distribution<int> any(0, kCount - 1);
  UnionFind sets(kCount);
  std::vector<int> labels(kCount);
  for (int i = 0; i < kCount; ++i) labels[i] = i;
  for (int step = 0; step < kCount; ++step) {
    const int a = any(random);
    const int b = any(random);
    sets.join(a, b);
    const auto [low, high] = std::minmax({labels[a], labels[b]});
    for (int& label : labels) label = label == high ? low : label;
    for (int i = 0; i < kCount; ++i) ASSERT_EQ(sets.root(i), labels[i]) << step;
  }
}

}  // namespace
}  // namespace mocha
