#include "perception/sensor/range_smoothing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <utility>

#include "perception/room.h"

namespace mocha {
namespace {

constexpr double kReach_m = 0.04;

PlanarScan noisy(PlanarScan scan, double noise_m) {
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0.0F, static_cast<float>(noise_m));
  for (float& range : scan.ranges_m) range += noise(random);
  return scan;
}

PlanarScan seen_from(const Room& room, const Vector2& place) {
  return sweep(room, [&](double) { return Pose{place, 0.0}; });
}

double worst_error_m(const PlanarScan& scan, const PlanarScan& truth, double farthest_m) {
  double worst_m = 0.0;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (truth.ranges_m[i] > farthest_m) continue;
    worst_m = std::max<double>(worst_m, std::abs(scan.ranges_m[i] - truth.ranges_m[i]));
  }
  return worst_m;
}

TEST(RangeSmoothing, TakesMostOfTheNoiseFromAWallCloseBy) {
  const Room room;
  const PlanarScan truth = seen_from(room, {0.0, room.low.y() + 0.3});
  const PlanarScan scan = noisy(truth, 0.01);
  EXPECT_GT(worst_error_m(scan, truth, 0.35), 0.02);
  EXPECT_LT(worst_error_m(smoothed(scan, kReach_m), truth, 0.35), 0.01);
}

TEST(RangeSmoothing, TakesItWhereAScanAllRoundBeginsAndEnds) {
  const Room room;
  const PlanarScan truth = seen_from(room, {room.low.x() + 0.3, 0.0});
  for (const std::size_t i : {std::size_t{0}, truth.ranges_m.size() - 1}) {
    ASSERT_NEAR(truth.ranges_m[i], 0.3, 1e-4);
    PlanarScan off = truth;
    off.ranges_m[i] += 0.015F;
    EXPECT_NEAR(smoothed(off, kReach_m).ranges_m[i], 0.3, 0.002) << i;
  }
}

TEST(RangeSmoothing, LeavesFlatWallsWhereTheyAre) {
  const Room room;
  const PlanarScan truth = seen_from(room, {0.0, room.low.y() + 0.3});
  EXPECT_LT(worst_error_m(smoothed(truth, kReach_m), truth, 3.0), 0.001);
}

TEST(RangeSmoothing, MovesRoundThingsByNoMoreThanItSays) {
  for (const double radius_m : {0.05, 0.1, 0.3}) {
    Room room;
    room.circles = {{{0.4 + radius_m, 0.0}, radius_m}};
    const PlanarScan truth = seen_from(room, {0.0, 0.0});
    const PlanarScan scan = smoothed(truth, kReach_m);
    const std::size_t ahead = truth.ranges_m.size() / 2;
    const double moved_m = scan.ranges_m[ahead] - truth.ranges_m[ahead];
    EXPECT_GT(moved_m, 0.0);
    EXPECT_LT(moved_m, kReach_m * kReach_m / (6.0 * radius_m) + 0.001) << radius_m;
  }
}

TEST(RangeSmoothing, KeepsThinThingsAndWhatIsNoHit) {
  const float miss = std::numeric_limits<float>::infinity();
  const float nothing = std::numeric_limits<float>::quiet_NaN();
  PlanarScan scan = seen_from(Room(), {0.0, 0.0});
  scan.ranges_m[100] = 1.0F;  // a wire
  scan.ranges_m[200] = miss;
  scan.ranges_m[300] = nothing;
  scan.ranges_m[400] = 0.5F * static_cast<float>(scan.range_min_m);
  const PlanarScan after = smoothed(scan, kReach_m);
  EXPECT_EQ(after.ranges_m[100], 1.0F);
  EXPECT_EQ(after.ranges_m[200], miss);
  EXPECT_TRUE(std::isnan(after.ranges_m[300]));
  EXPECT_EQ(after.ranges_m[400], scan.ranges_m[400]);
}

TEST(RangeSmoothing, WithoutReachItChangesNothing) {
  const PlanarScan scan = noisy(seen_from(Room(), {0.0, 0.0}), 0.01);
  EXPECT_EQ(smoothed(scan, 0.0).ranges_m, scan.ranges_m);
}

TEST(RangeSmoothing, TreatsAClockwiseScanAlike) {
  const PlanarScan scan = noisy(seen_from(Room(), {0.4, -0.7}), 0.01);
  PlanarScan clockwise = scan;
  std::swap(clockwise.angle_min_rad, clockwise.angle_max_rad);
  clockwise.angle_increment_rad = -scan.angle_increment_rad;
  std::reverse(clockwise.ranges_m.begin(), clockwise.ranges_m.end());
  PlanarScan back = smoothed(clockwise, kReach_m);
  std::reverse(back.ranges_m.begin(), back.ranges_m.end());
  EXPECT_NE(back.ranges_m, scan.ranges_m);
  const PlanarScan expected = smoothed(scan, kReach_m);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i)
    EXPECT_NEAR(back.ranges_m[i], expected.ranges_m[i], 1e-5) << i;
}

TEST(RangeSmoothing, TakesScansOfAnyLength) {
  PlanarScan scan;
  scan.range_max_m = 10.0;
  EXPECT_TRUE(smoothed(scan, kReach_m).ranges_m.empty());
  scan.ranges_m = {1.0F};
  EXPECT_EQ(smoothed(scan, kReach_m).ranges_m, scan.ranges_m);
}

/// What a lidar with a beam each 0.25 degrees meets, which looks along x from the origin.
template <class Seen>
PlanarScan scan_of(Seen seen) {
  PlanarScan scan;
  scan.angle_min_rad = -1.0;
  scan.angle_increment_rad = 0.25 * M_PI / 180.0;
  scan.range_min_m = 0.05F;
  scan.range_max_m = 30.0F;
  for (int i = 0; i < 459; ++i)
    scan.ranges_m.push_back(
        static_cast<float>(seen(scan.angle_min_rad + i * scan.angle_increment_rad)));
  return scan;
}

TEST(RangeSmoothing, AnEdgeThatPointsToTheLidarStaysWhereItIs) {
  for (const double edge_m : {0.3, 0.5, 1.0}) {
    // Two walls that meet there at a right angle.
    const PlanarScan corner = scan_of([&](double angle_rad) {
      return edge_m / (std::cos(angle_rad) - std::abs(std::sin(angle_rad)) + 1e-3);
    });
    EXPECT_LT(worst_error_m(smoothed(corner, kReach_m), corner, edge_m + 0.02), 0.008) << edge_m;
  }
}

TEST(RangeSmoothing, ALedgeOfAWallStaysWhereItIs) {
  const PlanarScan ledge = scan_of([](double angle_rad) {
    const bool meets = std::abs(std::tan(angle_rad)) * 0.5 < 0.006;
    return (meets ? 0.5 : 0.53) / std::cos(angle_rad);
  });
  EXPECT_LT(worst_error_m(smoothed(ledge, kReach_m), ledge, 0.51), 0.015);
}

}  // namespace
}  // namespace mocha
