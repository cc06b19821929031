#include "world/obstacle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace mocha {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Polygon square(double half) {
  return {{{-half, -half}, {half, -half}, {half, half}, {-half, half}}};
}

/// A U that is open upwards: 4 wide, 3 high, walls 1 thick.
Polygon open_box() { return {{{0, 0}, {4, 0}, {4, 3}, {3, 3}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}}; }

TEST(Obstacle, DistanceToACircle) {
  const Circle circle{{1.0, 2.0}, 0.5};
  EXPECT_NEAR(gap(Vector2(4.0, 6.0), circle).distance_m, 4.5, 1e-12);
  EXPECT_NEAR((gap(Vector2(4.0, 6.0), circle).place - Vector2(1.3, 2.4)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(gap(Vector2(1.0, 2.2), circle).distance_m, -0.3, 1e-12);
  EXPECT_NEAR(gap(circle.centre, circle).distance_m, -0.5, 1e-12);
}

TEST(Obstacle, DistanceToAPolygonThatIsNotConvex) {
  Polygon box = open_box();
  for (int sense = 0; sense < 2; ++sense) {
    EXPECT_NEAR(gap(Vector2(2.0, 2.0), box).distance_m, 1.0, 1e-12);   // in the hollow
    EXPECT_NEAR(gap(Vector2(2.0, 0.6), box).distance_m, -0.4, 1e-12);  // in the floor
    EXPECT_NEAR(gap(Vector2(0.3, 2.0), box).distance_m, -0.3, 1e-12);  // in the left wall
    EXPECT_NEAR(gap(Vector2(7.0, 7.0), box).distance_m, 5.0, 1e-12);   // off a corner
    EXPECT_NEAR(gap(Vector2(-1.0, 1.0), box).distance_m, 1.0, 1e-12);  // level with a corner
    std::reverse(box.corners.begin(), box.corners.end());
  }
}

TEST(Obstacle, GapsBetweenShapes) {
  const Obstacle disc = Circle{{0.0, 0.0}, 1.0};
  const Obstacle other = Circle{{0.0, 3.0}, 0.5};
  EXPECT_NEAR(gap(disc, other).distance_m, 1.5, 1e-12);
  EXPECT_NEAR((gap(disc, other).place - Vector2(0.0, 2.5)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(gap(disc, Circle{{1.2, 0.0}, 0.5}).distance_m, -0.3, 1e-12);

  const Obstacle wall = Polygon{{{2.0, -1.0}, {3.0, -1.0}, {3.0, 1.0}, {2.0, 1.0}}};
  EXPECT_NEAR(gap(disc, wall).distance_m, 1.0, 1e-12);
  EXPECT_NEAR(gap(wall, disc).distance_m, 1.0, 1e-12);
  EXPECT_NEAR((gap(disc, wall).place - Vector2(2.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((gap(wall, disc).place - Vector2(1.0, 0.0)).norm(), 0.0, 1e-12);

  EXPECT_NEAR(gap(Obstacle(square(0.5)), wall).distance_m, 1.5, 1e-12);
  EXPECT_NEAR(gap(Obstacle(square(2.2)), wall).distance_m, -0.2, 1e-12);
  EXPECT_LT(gap(Obstacle(square(0.1)), Obstacle(square(5.0))).distance_m, 0.0);  // all inside
  EXPECT_LT(gap(Obstacle(square(5.0)), Obstacle(square(0.1))).distance_m, 0.0);
}

TEST(Obstacle, BarsThatCrossOverlapThoughNoCornerIsInside) {
  const Obstacle along = Polygon{{{-3.0, -0.1}, {3.0, -0.1}, {3.0, 0.1}, {-3.0, 0.1}}};
  const Obstacle across = Polygon{{{-0.2, -3.0}, {0.2, -3.0}, {0.2, 3.0}, {-0.2, 3.0}}};
  const Gap overlap = gap(along, across);
  EXPECT_NEAR(overlap.distance_m, -0.1, 1e-12);
  EXPECT_NEAR(overlap.place.norm(), 0.0, 1e-12);
}

TEST(Obstacle, GapOfTurnedRectanglesMatchesDenseSampling) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-2.0, 2.0);
  const Footprint shape = Footprint::rectangle(1.2, 0.7);
  int apart = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Obstacle a = placed(shape, {{place(random), place(random)}, place(random)});
    const Obstacle b = placed(shape, {{place(random), place(random)}, place(random)});
    double sampled = kInfinity;
    const auto& corners = std::get<Polygon>(a).corners;
    for (std::size_t i = 0; i < 4; ++i) {
      for (double share = 0.0; share < 1.0; share += 0.005) {
        const Vector2 p = corners[i] + share * (corners[(i + 1) % 4] - corners[i]);
        sampled = std::min(sampled, gap(p, std::get<Polygon>(b)).distance_m);
      }
    }
    const double found = gap(a, b).distance_m;
    EXPECT_EQ(found > 0.0, sampled > 0.0) << trial;
    if (sampled <= 0.0) continue;
    ++apart;
    EXPECT_NEAR(found, sampled, 0.005) << trial;
    EXPECT_LE(found, sampled + 1e-12) << trial;
  }
  EXPECT_GT(apart, 50);
}

TEST(Obstacle, RaysMeetTheNearRim) {
  const Vector2 east(1.0, 0.0);
  const Circle circle{{3.0, 0.6}, 1.0};
  EXPECT_NEAR(ray_length({0, 0}, east, circle), 3.0 - 0.8, 1e-12);
  EXPECT_NEAR(ray_length({3, 0.6}, east, circle), 1.0, 1e-12);  // from inside
  EXPECT_EQ(ray_length({5, 0}, east, circle), kInfinity);       // behind
  EXPECT_EQ(ray_length({0, 1.7}, east, circle), kInfinity);     // beside

  const Polygon box = open_box();
  EXPECT_NEAR(ray_length({2, 2}, east, box), 1.0, 1e-12);
  EXPECT_NEAR(ray_length({-1, 2}, east, box), 1.0, 1e-12);
  EXPECT_NEAR(ray_length({2, 5}, Vector2(0.6, -0.8), box), 2.5, 1e-12);
  EXPECT_EQ(ray_length({2, 2}, Vector2(0.0, 1.0), box), kInfinity);
}

TEST(Obstacle, BadPolygonsAreNamed) {
  EXPECT_EQ(fault_of(open_box()), "");
  EXPECT_NE(fault_of({{{0, 0}, {1, 0}}}).find("at least 3"), std::string::npos);
  EXPECT_NE(fault_of({{{0, 0}, {1, 0}, {1, 0}, {0, 1}}}).find("repeated"), std::string::npos);
  EXPECT_NE(fault_of({{{0, 0}, {1, 1}, {1, 0}, {0, 1}}}).find("cross"), std::string::npos);
  EXPECT_NE(fault_of({{{0, 0}, {1, 1}, {2, 2}}}).find("no area"), std::string::npos);
  EXPECT_NE(fault_of({{{0, 0}, {NAN, 1}, {2, 2}}}).find("finite"), std::string::npos);
}

TEST(Obstacle, APlacedRectangleTurnsWithTheHeading) {
  const Obstacle body = placed(Footprint::rectangle(2.0, 1.0), {{5.0, 1.0}, M_PI / 2});
  const Polygon& polygon = std::get<Polygon>(body);
  EXPECT_NEAR(gap(Vector2(5.0, 2.5), polygon).distance_m, 0.5, 1e-12);  // ahead
  EXPECT_NEAR(gap(Vector2(6.0, 1.0), polygon).distance_m, 0.5, 1e-12);  // to the right
  EXPECT_TRUE(std::holds_alternative<Circle>(placed(Footprint::disc(0.3), {})));
}

}  // namespace
}  // namespace mocha
