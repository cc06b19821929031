#include "simulation/lidar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace mocha {
namespace {

constexpr float kNoReturn = std::numeric_limits<float>::infinity();

LidarModel model() {
  LidarModel lidar{};
  lidar.field_of_view_rad = 2.0 * M_PI;
  lidar.beams = 360;
  lidar.min_range_m = 0.1;
  lidar.max_range_m = 10.0;
  lidar.rate_hz = 10.0;
  return lidar;
}

Polygon box(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}};
}

Scan sweep(Lidar& lidar, const RayGrid& walls, const Pose& base,
           const std::vector<Obstacle>& moving = {}) {
  return lidar.sweep(5.0, {walls, [&](double) { return base; }, [&](double) { return moving; }});
}

TEST(RayGrid, AgreesWithCastingAgainstEverything) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-8.0, 8.0);
  std::uniform_real_distribution<double> size(0.02, 1.5);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI);
  std::vector<Circle> circles;
  std::vector<Polygon> polygons;
  for (int i = 0; i < 60; ++i)
    circles.push_back({{place(random), place(random)}, 0.3 * size(random)});
  for (int i = 0; i < 25; ++i) {
    const Vector2 a(place(random), place(random));
    polygons.push_back({{a, a + Vector2(size(random), 0.3), a + Vector2(0.1, size(random))}});
  }
  const RayGrid grid(circles, polygons);
  int hits = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    // From inside and outside the grid, along the axes as well.
    const Vector2 origin = 1.6 * Vector2(place(random), place(random));
    const double towards = trial % 10 == 0 ? (trial % 40 / 10) * M_PI / 2.0 : angle(random);
    const Vector2 direction(std::cos(towards), std::sin(towards));
    double expected = std::numeric_limits<double>::infinity();
    for (const auto& circle : circles) {
      expected = std::min(expected, ray_length(origin, direction, circle));
    }
    for (const auto& polygon : polygons) {
      expected = std::min(expected, ray_length(origin, direction, polygon));
    }
    if (expected > 12.0) expected = std::numeric_limits<double>::infinity();
    const double found = grid.ray_length(origin, direction, 12.0);
    ASSERT_EQ(std::isinf(found), std::isinf(expected)) << trial;
    if (std::isinf(found)) continue;
    ++hits;
    ASSERT_NEAR(found, expected, 1e-9) << trial;
  }
  EXPECT_GT(hits, 5000);
}

TEST(RayGrid, AWorldWithoutObstaclesHasNoReturns) {
  EXPECT_TRUE(std::isinf(RayGrid({}, {}).ray_length({0, 0}, {1, 0}, 100.0)));
}

TEST(Lidar, ARoomMeasuredExactly) {
  const RayGrid walls({}, {box(4, -20, 5, 20), box(-3, -20, -2, 20)});
  Lidar lidar(model(), 1);
  const Scan scan = sweep(lidar, walls, {});
  ASSERT_EQ(scan.ranges_m.size(), 360u);
  EXPECT_EQ(scan.start_time_s, 5.0);
  for (int i = 0; i < 360; ++i) {
    const double angle = lidar.angle_min_rad() + i * lidar.angle_increment_rad();
    const double c = std::cos(angle);
    const double expected = c > 0.0 ? 4.0 / c : 2.0 / -c;
    if (expected > 10.0) {
      EXPECT_EQ(scan.ranges_m[i], kNoReturn) << i;
    } else {
      EXPECT_NEAR(scan.ranges_m[i], expected, 1e-5) << i;
    }
  }
}

TEST(Lidar, AllRoundDoesNotRepeatTheFirstBeamAndASectorReachesBothEnds) {
  const Lidar round(model(), 1);
  EXPECT_NEAR(round.angle_increment_rad() * 360, 2.0 * M_PI, 1e-12);
  LidarModel sector = model();
  sector.field_of_view_rad = 1.5 * M_PI;
  sector.beams = 1081;
  const Lidar wide(sector, 1);
  EXPECT_NEAR(wide.angle_increment_rad(), M_PI / 720.0, 1e-12);
  EXPECT_NEAR(wide.angle_min_rad() + 1080 * wide.angle_increment_rad(), 0.75 * M_PI, 1e-9);
}

TEST(Lidar, TheMountCounts) {
  LidarModel mounted = model();
  mounted.mount = {{0.5, 0.0}, M_PI / 2};
  Lidar lidar(mounted, 1);
  // The robot looks north; its lidar is 0.5 m ahead and looks west.
  const RayGrid walls({}, {box(-3, -5, -2, 5)});
  const Scan scan = sweep(lidar, walls, {{1.0, 1.0}, M_PI / 2});
  EXPECT_NEAR(scan.ranges_m[180], 3.0, 1e-5);
}

TEST(Lidar, SeesMovingDiscsAndRectanglesInFrontOfWalls) {
  const RayGrid walls({{{6.0, 0.0}, 1.0}}, {});
  Lidar lidar(model(), 1);
  EXPECT_NEAR(sweep(lidar, walls, {}).ranges_m[180], 5.0, 1e-5);
  EXPECT_NEAR(sweep(lidar, walls, {}, {Circle{{3.0, 0.0}, 0.5}}).ranges_m[180], 2.5, 1e-5);
  EXPECT_NEAR(sweep(lidar, walls, {}, {Circle{{9.0, 0.0}, 0.5}}).ranges_m[180], 5.0, 1e-5);
  EXPECT_NEAR(sweep(lidar, walls, {}, {box(2.0, -0.2, 3.0, 0.2)}).ranges_m[180], 2.0, 1e-5);
}

TEST(Lidar, RangesBeyondItsLimits) {
  Lidar lidar(model(), 1);
  const RayGrid walls({{{10.7, 0.0}, 0.5}, {{-0.55, 0.0}, 0.5}}, {});
  const Scan scan = sweep(lidar, walls, {});
  EXPECT_EQ(scan.ranges_m[180], kNoReturn);  // ahead: 10.2 m
  EXPECT_EQ(scan.ranges_m[0], 0.0f);         // astern: 0.05 m
}

TEST(Lidar, EachBeamIsMeasuredAtItsOwnTime) {
  LidarModel sweeping = model();
  sweeping.sweep_time_s = 0.1;
  Lidar lidar(sweeping, 1);
  EXPECT_NEAR(lidar.time_increment_s() * 359, 0.1, 1e-12);
  // The robot drives east at 10 m/s; a disc ahead flees at 20 m/s.
  const RayGrid walls({}, {box(-1, 3, 20, 4)});
  const Scan scan =
      lidar.sweep(2.0, {walls,
                        [](double t) {
                          return Pose{{10.0 * (t - 2.0), 0.0}, 0.0};
                        },
                        [](double t) {
                          return std::vector<Obstacle>{Circle{{5.0 + 20.0 * (t - 2.0), 0.0}, 1.0}};
                        }});
  const double middle = 180 * lidar.time_increment_s();
  EXPECT_NEAR(scan.ranges_m[180], 4.0 + 20.0 * middle - 10.0 * middle, 1e-4);
  EXPECT_NEAR(scan.ranges_m[270], 3.0, 1e-4);  // straight left, at whatever time
}

TEST(Lidar, NoiseAndDropoutsAreAsSpecifiedAndRepeatWithTheSeed) {
  LidarModel noisy = model();
  noisy.noise_m = 0.03;
  noisy.dropout = 0.1;
  Lidar first(noisy, 42);
  Lidar second(noisy, 42);
  const RayGrid walls({{{0.0, 0.0}, 5.0}}, {});  // seen from its centre
  double sum = 0.0;
  double squares = 0.0;
  int returns = 0;
  int lost = 0;
  for (int i = 0; i < 50; ++i) {
    const Scan scan = sweep(first, walls, {});
    EXPECT_EQ(scan.ranges_m, sweep(second, walls, {}).ranges_m);
    for (float range : scan.ranges_m) {
      if (std::isinf(range)) {
        ++lost;
        continue;
      }
      ++returns;
      sum += range - 5.0;
      squares += (range - 5.0) * (range - 5.0);
    }
  }
  EXPECT_NEAR(lost / 18000.0, 0.1, 0.01);
  EXPECT_NEAR(sum / returns, 0.0, 0.001);
  EXPECT_NEAR(std::sqrt(squares / returns), 0.03, 0.001);
}

}  // namespace
}  // namespace mocha
