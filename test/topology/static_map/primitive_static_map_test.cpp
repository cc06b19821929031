#include "topology/static_map/primitive_static_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace mocha {
namespace {

constexpr double kClearance_m = 0.3;

std::vector<ObstacleGroup> groups_of(const std::vector<Obstacle>& obstacles,
                                     double clearance_m = kClearance_m) {
  const Eigen::AlignedBox2d bounds(Vector2(0.0, 0.0), Vector2(10.0, 10.0));
  const PrimitiveStaticMap static_map(std::make_shared<PrimitiveField<2>>(obstacles, 2.0), bounds);
  return static_map.groups(clearance_m);
}

Polygon box(double x, double y, double width, double height) {
  return {{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}};
}

bool holds(const Obstacle& obstacle, const Vector2& p) {
  return std::visit([&](const auto& shape) { return gap(p, shape).distance_m <= 1e-9; }, obstacle);
}

/// In which group the obstacle is, by where its representative or its circles are.
int group_with(const std::vector<ObstacleGroup>& groups, const Obstacle& obstacle) {
  for (std::size_t r = 0; r < groups.size(); ++r) {
    for (const Circle& circle : groups[r].cover)
      if (holds(obstacle, circle.centre)) return static_cast<int>(r);
  }
  return -1;
}

TEST(PrimitiveStaticMap, ShowsItsFieldAndBounds) {
  const auto field = std::make_shared<PrimitiveField<2>>(std::vector<Obstacle>{}, 2.0);
  const Eigen::AlignedBox2d bounds(Vector2(-1.0, -2.0), Vector2(3.0, 4.0));
  const PrimitiveStaticMap static_map(field, bounds);
  EXPECT_EQ(&static_map.field(), field.get());
  EXPECT_TRUE(static_map.bounds().isApprox(bounds));
  EXPECT_GT(static_map.detail_m(), 0.0);
  EXPECT_TRUE(static_map.groups(kClearance_m).empty());
}

TEST(PrimitiveStaticMap, ACircleStandsForItself) {
  const auto groups = groups_of({Circle{{3.0, 4.0}, 0.7}});
  ASSERT_EQ(groups.size(), 1u);
  EXPECT_EQ(groups[0].representative, Vector2(3.0, 4.0));
  ASSERT_EQ(groups[0].cover.size(), 1u);
  EXPECT_EQ(groups[0].cover[0].centre, Vector2(3.0, 4.0));
  EXPECT_EQ(groups[0].cover[0].radius_m, 0.7);
}

TEST(PrimitiveStaticMap, JoinsWhatTheRobotCannotPassBetween) {
  for (const double gap_m : {0.59, 0.61}) {
    const std::size_t apart = gap_m < 2.0 * kClearance_m ? 0 : 1;
    EXPECT_EQ(groups_of({Circle{{2.0, 2.0}, 0.5}, Circle{{3.0 + gap_m, 2.0}, 0.5}}).size(),
              1 + apart);
    EXPECT_EQ(groups_of({box(1.0, 1.0, 1.0, 2.0), box(2.0 + gap_m, 1.5, 1.0, 2.0)}).size(),
              1 + apart);
    EXPECT_EQ(groups_of({box(1.0, 1.0, 1.0, 2.0), Circle{{2.5 + gap_m, 2.0}, 0.5}}).size(),
              1 + apart);
    // Corner to corner, where their boxes are nearer than they are.
    const double side_m = gap_m * M_SQRT1_2;
    EXPECT_EQ(
        groups_of({box(1.0, 1.0, 1.0, 1.0), box(2.0 + side_m, 2.0 + side_m, 1.0, 1.0)}).size(),
        1 + apart);
  }
}

TEST(PrimitiveStaticMap, AChainIsOneGroupInWhateverOrderItsLinksAreListed) {
  std::vector<Obstacle> chain;
  for (int i = 0; i < 8; ++i) {
    if (i % 2 == 0) chain.push_back(Circle{{1.0 + i, 5.0}, 0.3});
    if (i % 2 == 1) chain.push_back(box(0.8 + i, 4.7, 0.4, 0.6));
  }
  chain.push_back(Circle{{5.0, 8.0}, 0.3});
  std::mt19937 random(5);
  for (int round = 0; round < 50; ++round) {
    std::shuffle(chain.begin(), chain.end(), random);
    const auto groups = groups_of(chain);
    ASSERT_EQ(groups.size(), 2u);
    const int alone = std::abs(groups[0].representative.y() - 8.0) < 0.5 ? 0 : 1;
    EXPECT_EQ(groups[alone].cover.size(), 1u);
    EXPECT_NEAR(groups[1 - alone].representative.y(), 5.0, 0.31);
  }
  EXPECT_EQ(groups_of(chain, 0.1).size(), 9u) << "a smaller robot passes between the links";
}

/// Groups are what hangs together by gaps that are too narrow: tried pair by pair.
TEST(PrimitiveStaticMap, GroupsAreConnectedByNarrowGaps) {
  for (int seed = 1; seed <= 50; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    std::vector<Obstacle> obstacles;
    for (int i = 0; i < 30; ++i) {
      const double x = 10.0 * share(random);
      const double y = 10.0 * share(random);
      const double size_m = 0.1 + 0.5 * share(random);
      if (i % 2 == 0) obstacles.push_back(Circle{{x, y}, size_m});
      if (i % 2 == 1) obstacles.push_back(box(x, y, size_m, 1.2 * share(random) + 0.1));
    }
    std::vector<int> part(obstacles.size());
    for (std::size_t i = 0; i < part.size(); ++i) part[i] = static_cast<int>(i);
    for (std::size_t i = 0; i < part.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (gap(obstacles[i], obstacles[j]).distance_m < 2.0 * kClearance_m)
          std::replace(part.begin(), part.end(), int(part[i]), int(part[j]));
      }
    }
    const auto groups = groups_of(obstacles);
    std::vector<int> parts = part;
    std::sort(parts.begin(), parts.end());
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
    EXPECT_EQ(groups.size(), parts.size()) << seed;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const int group = group_with(groups, obstacles[i]);
      ASSERT_GE(group, 0);
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_EQ(group == group_with(groups, obstacles[j]), part[i] == part[j]) << seed;
    }
    for (const ObstacleGroup& group : groups) {
      EXPECT_TRUE(std::any_of(obstacles.begin(), obstacles.end(), [&](const Obstacle& obstacle) {
        return holds(obstacle, group.representative);
      }));
    }
  }
}

TEST(PrimitiveStaticMap, NobodyFitsBetweenThePointsOnAPolygonsRim) {
  const Polygon shape{{{1.0, 1.0}, {6.05, 1.3}, {5.0, 4.0}, {4.0, 1.5}, {1.2, 1.5}}};
  for (const double clearance_m : {0.1, 0.3, 0.5}) {
    const auto groups = groups_of({shape}, clearance_m);
    ASSERT_EQ(groups.size(), 1u);
    const auto& circles = groups[0].cover;
    for (const Circle& circle : circles) {
      EXPECT_EQ(circle.radius_m, 0.0);
      EXPECT_NEAR(gap(circle.centre, shape).distance_m, 0.0, 1e-9);
    }
    for (std::size_t i = 0; i < shape.corners.size(); ++i) {
      const Vector2& from = shape.corners[i];
      const Vector2& to = shape.corners[(i + 1) % shape.corners.size()];
      for (double share = 0.0; share < 1.0; share += 1e-3) {
        const Vector2 p = from + share * (to - from);
        double nearest_m = 1e9;
        for (const Circle& circle : circles)
          nearest_m = std::min(nearest_m, (circle.centre - p).norm());
        // homotopy_paths.cpp lets the roadmap come as close as half of the clearance.
        EXPECT_LE(nearest_m, 0.5 * clearance_m);
      }
    }
  }
}

TEST(PrimitiveStaticMap, SeesOnlyTheWindow) {
  // A chain whose middle is outside of the window.
  const std::vector<Obstacle> obstacles = {Circle{{2.0, 5.0}, 0.5}, Circle{{2.0, 3.5}, 0.8},
                                           box(2.5, 2.5, 2.5, 0.5), Circle{{5.0, 4.0}, 0.9},
                                           Circle{{5.0, 5.2}, 0.5}};
  const Eigen::AlignedBox2d bounds(Vector2(0.0, 0.0), Vector2(10.0, 10.0));
  const PrimitiveStaticMap static_map(std::make_shared<PrimitiveField<2>>(obstacles, 2.0), bounds);
  EXPECT_EQ(static_map.groups(kClearance_m).size(), 1u);
  const auto groups =
      static_map.groups_within({Vector2(0.0, 4.95), Vector2(9.0, 9.0)}, kClearance_m);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].representative, Vector2(2.0, 5.0));
  EXPECT_EQ(groups[1].representative, Vector2(5.0, 5.2));
}

}  // namespace
}  // namespace mocha
