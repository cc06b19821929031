#include "world/distances/distance_repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "world/distances/distance_field.h"

namespace mocha {
namespace {

constexpr int kColumns = 70;
constexpr int kRows = 50;
constexpr float kStep_m = 0.05f;

/// Signed distances to sites, one corner after the other.
std::vector<float> distances(const std::vector<Eigen::Vector2i>& sites, int side) {
  std::vector<float> signed_m;
  for (int y = 0; y < kRows; ++y) {
    for (int x = 0; x < kColumns; ++x) {
      int least = 1 << 20;
      for (const Eigen::Vector2i& site : sites)
        least = std::min(least, (site - Eigen::Vector2i(x, y)).squaredNorm());
      signed_m.push_back(least == 0 ? 0.0f : side * kStep_m * std::sqrt(static_cast<float>(least)));
    }
  }
  return signed_m;
}

TEST(DistanceRepair, SitesThatComeAndGoLeaveExactDistances) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const int side = trial % 2 == 0 ? 1 : -1;
    std::vector<Eigen::Vector2i> sites;
    const int count = 2 + static_cast<int>(random() % 60);
    const bool in_a_wall = trial % 3 == 0;
    for (int i = 0; i < count; ++i) {
      const int x = in_a_wall ? 5 + i : static_cast<int>(random() % kColumns);
      const int y = in_a_wall ? 20 + i / 7 : static_cast<int>(random() % kRows);
      if (std::find(sites.begin(), sites.end(), Eigen::Vector2i(x, y)) == sites.end())
        sites.emplace_back(x, y);
    }
    std::vector<float> repaired = distances(sites, side);
    const std::vector<float> before = repaired;
    std::shuffle(sites.begin(), sites.end(), random);
    const auto take = [&](std::size_t most) {
      const auto end = sites.end();
      const auto begin = end - static_cast<long>(std::min(most, sites.size() / 2));
      std::vector<Eigen::Vector2i> taken(begin, end);
      sites.erase(begin, end);
      return taken;
    };
    const std::vector<Eigen::Vector2i> gone = take(random() % 4);
    const std::vector<Eigen::Vector2i> come = [&] {
      std::vector<Eigen::Vector2i> some;
      for (std::size_t i = random() % 4; i > 0; --i) {
        const Eigen::Vector2i at(random() % kColumns, random() % kRows);
        if (before[at.y() * kColumns + at.x()] != 0.0f &&
            std::find(some.begin(), some.end(), at) == some.end())
          some.push_back(at);
      }
      return some;
    }();
    DistanceRepair repair(repaired, kColumns, kRows, kStep_m, side);
    ASSERT_TRUE(repair.remove(gone));
    repair.add(come);
    sites.insert(sites.end(), come.begin(), come.end());
    const std::vector<float> fresh = distances(sites, side);
    for (int i = 0; i < kColumns * kRows; ++i) {
      const int x = i % kColumns;
      const int y = i / kColumns;
      ASSERT_EQ(repaired[i], fresh[i]) << trial << ": " << x << " " << y;
      const auto holds = [&](const CornerWindow& window) { return window.holds(x, y); };
      const auto& touched = repair.touched();
      EXPECT_TRUE(fresh[i] == before[i] || std::any_of(touched.begin(), touched.end(), holds));
    }
  }
}

TEST(DistanceRepair, RefusesWhereAllDependsOnWhatGoes) {
  std::vector<float> wide(200 * 200);
  for (int i = 0; i < 200 * 200; ++i)
    wide[i] = kStep_m * std::hypot(static_cast<float>(i % 200 - 100), static_cast<float>(i / 200));
  DistanceRepair repair(wide, 200, 200, kStep_m, 1);
  EXPECT_FALSE(repair.remove({{100, 0}}));
}

TEST(DistanceRepair, NarrowWedgesOfAWideHallTouchLittle) {
  OccupancyGrid hall;
  hall.width = hall.height = 600;
  hall.cells.assign(600 * 600, OccupancyGrid::kFree);
  for (int i = 0; i < 600; ++i) {
    for (int k : {0, 599}) hall.at(i, k) = hall.at(k, i) = OccupancyGrid::kOccupied;
  }
  DistanceField field(hall, DistanceField::Solid::kOccupied);
  std::mt19937 random(2);
  for (int trial = 0; trial < 20; ++trial) {
    // A cell of the wall, or before it.
    const int at = 10 + static_cast<int>(random() % 580);
    std::int8_t& cell = hall.at(at, trial % 2);
    cell = cell == OccupancyGrid::kFree ? OccupancyGrid::kOccupied : OccupancyGrid::kFree;
    const CornerWindow where{at, trial % 2, at, trial % 2};
    long touched = 0;
    for (const CornerWindow& window : field.repair(hall, {where}))
      touched += window.columns() * window.rows();
    EXPECT_LT(touched, 600 * 600 / 4);
    const DistanceField fresh(hall, DistanceField::Solid::kOccupied);
    for (int y = 0; y < field.rows(); ++y) {
      for (int x = 0; x < field.columns(); ++x)
        ASSERT_EQ(field.at_corner(x, y), fresh.at_corner(x, y)) << trial << ": " << x << " " << y;
    }
  }
}

TEST(DistanceRepair, WhatAllDependsOnMayGoFromAField) {
  OccupancyGrid plain;
  plain.width = plain.height = 200;
  plain.cells.assign(200 * 200, OccupancyGrid::kFree);
  plain.at(100, 50) = plain.at(20, 150) = OccupancyGrid::kOccupied;
  DistanceField field(plain, DistanceField::Solid::kOccupied);
  for (const CornerWindow& where : {CornerWindow{100, 50, 100, 50}, {20, 150, 20, 150}}) {
    plain.at(where.x0, where.y0) = OccupancyGrid::kFree;
    field.repair(plain, {where});
    const DistanceField fresh(plain, DistanceField::Solid::kOccupied);
    for (int y = 0; y < field.rows(); ++y) {
      for (int x = 0; x < field.columns(); ++x)
        ASSERT_EQ(field.at_corner(x, y), fresh.at_corner(x, y)) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace mocha
