#include "world/disc_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace mocha {
namespace {

constexpr double kReach_m = 2.0;

std::vector<CoverDisc> random_discs(int count, int seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place_m(-1.0, 1.0);
  std::uniform_real_distribution<double> radius_m(0.01, 0.5);
  std::vector<CoverDisc> discs;
  for (int i = 0; i < count; ++i) {
    const double x = place_m(random);
    const double y = place_m(random);
    discs.push_back({{x, y}, radius_m(random)});
  }
  return discs;
}

double gap_m(const CoverDisc& disc, const Vector2& p) {
  return (disc.offset_m - p).norm() - disc.radius_m;
}

double least_gap_m(const DiscTree& tree, const Vector2& p) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const CoverDisc& disc : tree.discs()) least_m = std::min(least_m, gap_m(disc, p));
  return least_m;
}

TEST(DiscTree, AnswersAsIfEveryDiscWereAsked) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place_m(-2.5, 2.5);
  for (int count = 1; count <= 20; ++count) {
    const DiscTree tree(random_discs(count, count), kReach_m);
    ASSERT_EQ(tree.discs().size(), static_cast<std::size_t>(count));
    for (int i = 0; i < 200; ++i) {
      const Vector2 p(place_m(random), place_m(random));
      const double least_m = least_gap_m(tree, p);
      EXPECT_NEAR(tree.least([&](const CoverDisc& disc) { return gap_m(disc, p); }), least_m,
                  1e-12);
      for (const double asked_m : {least_m - 1e-6, least_m + 1e-6, 0.3}) {
        const bool all = tree.all([&](const CoverDisc& disc) { return gap_m(disc, p) >= asked_m; });
        EXPECT_EQ(all, least_m >= asked_m) << count << " " << i;
      }
    }
  }
}

TEST(DiscTree, AsksLittleWhereThereIsRoom) {
  const DiscTree tree(random_discs(20, 3), kReach_m);
  const auto asked = [&](const Vector2& p) {
    int count = 0;
    tree.all([&](const CoverDisc& disc) {
      ++count;
      return gap_m(disc, p) >= 0.0;
    });
    return count;
  };
  EXPECT_EQ(asked({2.1, 0.0}), 1);
  EXPECT_LE(asked({1.7, 0.0}), 12);
}

TEST(DiscTree, WhatIsNotANumberHoldsNowhere) {
  const DiscTree tree(random_discs(5, 4), kReach_m);
  EXPECT_FALSE(tree.all([](const CoverDisc&) { return std::nan("") >= 0.0; }));
}

TEST(DiscTree, KnowsHowFarItsDiscsAreOffTheBase) {
  const DiscTree tree(random_discs(9, 5), kReach_m);
  tree.all([](const DiscTree::Node& node) {
    EXPECT_DOUBLE_EQ(node.arm_m, node.offset_m.norm());
    return false;
  });
}

}  // namespace
}  // namespace mocha
