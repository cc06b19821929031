#include "perception/monitoring/range_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "perception/monitoring/blind_beams.h"
#include "perception/monitoring/frozen_scan.h"
#include "perception/shipped_options.h"

namespace mocha {
namespace {

constexpr int kBeams = 720;
constexpr float kNoReturn = std::numeric_limits<float>::infinity();

/// From the middle of a room of 6 x 4 m.
PlanarScan room(double noise_m, std::uint32_t seed = 1) {
  PlanarScan scan;
  scan.angle_min_rad = -M_PI;
  scan.angle_increment_rad = 2.0 * M_PI / kBeams;
  scan.angle_max_rad = scan.angle_min_rad + (kBeams - 1) * scan.angle_increment_rad;
  scan.range_min_m = 0.1;
  scan.range_max_m = 25.0;
  std::mt19937 random(seed);
  std::normal_distribution<double> noise;
  for (int i = 0; i < kBeams; ++i) {
    const double angle = scan.angle_min_rad + i * scan.angle_increment_rad;
    const double range = std::min(3.0 / std::max(1e-9, std::abs(std::cos(angle))),
                                  2.0 / std::max(1e-9, std::abs(std::sin(angle))));
    scan.ranges_m.push_back(static_cast<float>(range + noise_m * noise(random)));
  }
  return scan;
}

TEST(RangeNoise, IsThatOfTheRanges) {
  for (const double noise_m : {0.0, 0.01, 0.03})
    EXPECT_NEAR(*range_noise_m(room(noise_m)), noise_m, 0.15 * noise_m + 1e-5);
}

TEST(RangeNoise, IsNotKnownInTheOpen) {
  PlanarScan scan = room(0.01);
  for (float& range : scan.ranges_m) range = kNoReturn;
  EXPECT_FALSE(range_noise_m(scan));
}

TEST(FrozenScan, RepeatsWhileTheRobotMoves) {
  FrozenScan frozen;
  const PlanarScan scan = room(0.01);
  for (int i = 0; i < 4; ++i) frozen.add(scan.ranges_m, {{0.1 * i, 0.0}, 0.0});
  EXPECT_EQ(frozen.repeats(), 3);
  EXPECT_NEAR(frozen.moved_m(), 0.3, 1e-12);
  frozen.add(room(0.01, 2).ranges_m, {{0.4, 0.0}, 0.0});
  EXPECT_EQ(frozen.repeats(), 0);
  EXPECT_EQ(frozen.moved_m(), 0.0);
}

TEST(FrozenScan, NothingInSightMayStayNothing) {
  FrozenScan frozen;
  const std::vector<float> nothing(kBeams, kNoReturn);
  for (int i = 0; i < 4; ++i) frozen.add(nothing, {{0.1 * i, 0.0}, 0.0});
  EXPECT_EQ(frozen.repeats(), 0);
}

TEST(BlindBeams, PassWallsOfTheMap) {
  const SweepPoses poses{Eigen::Isometry3d::Identity(), Eigen::Isometry3d::Identity()};
  const BeamReach reach{30.0, 10.0};
  OccupancyMap map(shipped_map_options());
  PlanarScan scan = room(0.0);
  EXPECT_EQ(blind_beams(to_beams(scan, poses, reach), scan.angle_increment_rad, map).width_rad,
            0.0);
  for (int i = 0; i < 5; ++i) map.insert_scan(to_beams(scan, poses, reach));
  EXPECT_EQ(blind_beams(to_beams(scan, poses, reach), scan.angle_increment_rad, map).width_rad,
            0.0);
  for (int i = 480; i < 600; ++i) scan.ranges_m[i] = kNoReturn;  // 60 degrees about 90
  const BlindBeams blind = blind_beams(to_beams(scan, poses, reach), scan.angle_increment_rad, map);
  EXPECT_NEAR(blind.width_rad, M_PI / 3.0, 0.1);
  EXPECT_NEAR(blind.middle_rad, M_PI / 2.0, 0.05);
}

}  // namespace
}  // namespace mocha
