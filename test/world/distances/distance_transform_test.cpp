#include "world/distances/distance_transform.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <random>

namespace mocha {
namespace {

float brute_force(const std::vector<float>& sites, int columns, int rows, int x, int y) {
  float least = kNoSite;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      if (sites[j * columns + i] != 0.0f) continue;
      least = std::min(least, static_cast<float>((i - x) * (i - x) + (j - y) * (j - y)));
    }
  }
  return least;
}

void expect_exact(const std::vector<float>& sites, int columns, int rows) {
  std::vector<float> squared = sites;
  distance_transform(squared, columns, rows);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      ASSERT_EQ(squared[y * columns + x], brute_force(sites, columns, rows, x, y))
          << "at (" << x << ", " << y << ") of " << columns << " x " << rows;
    }
  }
}

TEST(DistanceTransform, IsExactWhereverSitesAre) {
  std::mt19937 random(1);
  for (const double share : {0.001, 0.01, 0.1, 0.5, 0.9}) {
    for (int run = 0; run < 40; ++run) {
      const int columns = std::uniform_int_distribution<int>(1, 70)(random);
      const int rows = std::uniform_int_distribution<int>(1, 40)(random);
      std::bernoulli_distribution is_site(share);
      std::vector<float> sites(static_cast<std::size_t>(columns) * rows);
      for (float& site : sites) site = is_site(random) ? 0.0f : kNoSite;
      ASSERT_NO_FATAL_FAILURE(expect_exact(sites, columns, rows)) << "share " << share;
    }
  }
}

TEST(DistanceTransform, IsExactFarFromASingleSite) {
  for (const int at : {0, 17, 899}) {
    std::vector<float> sites(900 * 3, kNoSite);
    sites[900 + at] = 0.0f;
    expect_exact(sites, 900, 3);
    expect_exact(sites, 3, 900);
  }
}

TEST(DistanceTransform, LeavesALatticeWithoutSitesFar) {
  std::vector<float> squared(12, kNoSite);
  distance_transform(squared, 4, 3);
  EXPECT_EQ(squared, std::vector<float>(12, kNoSite));
}

TEST(DistanceTransform, IsExactInSpace) {
  std::mt19937 random(2);
  for (int run = 0; run < 60; ++run) {
    const int columns = std::uniform_int_distribution<int>(1, 16)(random);
    const int rows = std::uniform_int_distribution<int>(1, 14)(random);
    const int layers = std::uniform_int_distribution<int>(1, 12)(random);
    std::bernoulli_distribution is_site(run % 2 == 0 ? 0.01 : 0.2);
    std::vector<float> sites(static_cast<std::size_t>(columns) * rows * layers);
    for (float& site : sites) site = is_site(random) ? 0.0f : kNoSite;
    std::vector<float> squared = sites;
    distance_transform_in_space(squared, columns, rows, layers);
    const auto place = [&](int i) {
      return Eigen::Vector3i(i % columns, i / columns % rows, i / columns / rows);
    };
    for (int i = 0; i < static_cast<int>(sites.size()); ++i) {
      float least = kNoSite;
      for (int k = 0; k < static_cast<int>(sites.size()); ++k) {
        if (sites[k] == 0.0f)
          least = std::min(least, static_cast<float>((place(k) - place(i)).squaredNorm()));
      }
      ASSERT_EQ(squared[i], least) << columns << " x " << rows << " x " << layers << ", " << i;
    }
  }
}

}  // namespace
}  // namespace mocha
