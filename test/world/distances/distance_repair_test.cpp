#include "world/distances/distance_repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace mocha {
namespace {

using Sites = std::vector<Eigen::Vector2i>;

constexpr float kStep_m = 0.05f;
constexpr std::int64_t kAnyWork = 1 << 30;

/// A lattice with sites, and the signed distances that they make.
struct Case {
  int columns;
  int rows;
  int side;
  Sites sites;

  std::vector<float> distances_m() const {
    std::vector<float> signed_m;
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) {
        int least = 1 << 24;
        for (const Eigen::Vector2i& site : sites)
          least = std::min(least, (site - Eigen::Vector2i(x, y)).squaredNorm());
        signed_m.push_back(least == 0 ? 0.0f
                                      : side * kStep_m * std::sqrt(static_cast<float>(least)));
      }
    }
    return signed_m;
  }
  bool has(const Eigen::Vector2i& site) const {
    return std::find(sites.begin(), sites.end(), site) != sites.end();
  }
  DistanceRepair repair(std::vector<float>& signed_m, std::int64_t most_work = kAnyWork) const {
    return DistanceRepair(signed_m, columns, rows, kStep_m, side, most_work);
  }
};

/// Sites in a wall, or here and there.
Case random_case(int trial, std::mt19937& random) {
  Case made{70, 50, trial % 2 == 0 ? 1 : -1, {}};
  const int count = 2 + static_cast<int>(random() % 60);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2i site = trial % 3 == 0 ? Eigen::Vector2i(5 + i, 20 + i / 7)
                                                : Eigen::Vector2i(random() % 70, random() % 50);
    if (!made.has(site)) made.sites.push_back(site);
  }
  std::shuffle(made.sites.begin(), made.sites.end(), random);
  return made;
}

void expect_exact(Case here, const Sites& gone, const Sites& come) {
  std::vector<float> repaired = here.distances_m();
  const std::vector<float> before = repaired;
  DistanceRepair repair = here.repair(repaired);
  ASSERT_TRUE(repair.remove(gone));
  ASSERT_TRUE(repair.add(come));
  const auto is_gone = [&](const Eigen::Vector2i& site) {
    return std::find(gone.begin(), gone.end(), site) != gone.end();
  };
  here.sites.erase(std::remove_if(here.sites.begin(), here.sites.end(), is_gone), here.sites.end());
  here.sites.insert(here.sites.end(), come.begin(), come.end());
  const std::vector<float> fresh = here.distances_m();
  for (int i = 0; i < here.columns * here.rows; ++i) {
    const int x = i % here.columns;
    const int y = i / here.columns;
    ASSERT_EQ(repaired[i], fresh[i]) << x << " " << y;
    const auto holds = [&](const CornerWindow& window) { return window.holds(x, y); };
    EXPECT_TRUE(fresh[i] == before[i] ||
                std::any_of(repair.touched().begin(), repair.touched().end(), holds));
  }
}

TEST(DistanceRepair, SitesThatComeAndGoLeaveExactDistances) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const Case here = random_case(trial, random);
    const std::size_t most = here.sites.size() / 2;
    const Sites gone(here.sites.begin(), here.sites.begin() + std::min(most, random() % 4));
    Sites come;
    for (std::size_t i = random() % 4; i > 0; --i) {
      const Eigen::Vector2i site(random() % 70, random() % 50);
      if (!here.has(site) && std::find(come.begin(), come.end(), site) == come.end())
        come.push_back(site);
    }
    expect_exact(here, gone, come);
  }
}

TEST(DistanceRepair, FollowsACellThatIsThinnerThanTheLattice) {
  expect_exact({10, 25, 1, {{2, 6}, {6, 5}, {0, 7}}}, {{2, 6}}, {});
}

TEST(DistanceRepair, IsExactFarFromAllSites) {
  expect_exact({4000, 2, 1, {{0, 0}, {3999, 1}}}, {{3999, 1}}, {{3, 1}});
}

TEST(DistanceRepair, RefusesWhatTakesTooMuchWork) {
  const Case lonely{200, 200, 1, {{100, 0}, {0, 150}}};
  std::vector<float> signed_m = lonely.distances_m();
  EXPECT_FALSE(lonely.repair(signed_m, 1000).remove({{100, 0}}));
  signed_m = lonely.distances_m();
  EXPECT_FALSE(lonely.repair(signed_m, 1000).add({{150, 190}}));
  signed_m = lonely.distances_m();
  EXPECT_TRUE(lonely.repair(signed_m).remove({{100, 0}}));
}

TEST(DistanceRepair, TouchesLittleOfAWideHall) {
  Case hall{600, 300, 1, {}};
  for (int x = 0; x < hall.columns; ++x) hall.sites.emplace_back(x, 0);
  std::vector<float> signed_m;
  for (int i = 0; i < hall.columns * hall.rows; ++i)
    signed_m.push_back(kStep_m * static_cast<float>(i / hall.columns));
  DistanceRepair repair = hall.repair(signed_m, 200 * hall.columns);
  EXPECT_TRUE(repair.remove({{300, 0}}));
  EXPECT_TRUE(repair.add({{300, 0}}));
  long touched = 0;
  for (const CornerWindow& window : repair.touched()) touched += window.columns() * window.rows();
  EXPECT_LT(touched, 2 * hall.rows);
}

}  // namespace
}  // namespace mocha
