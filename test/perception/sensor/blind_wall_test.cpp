#include "perception/sensor/blind_wall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace mocha {
namespace {

constexpr double kSees_rad = 0.75 * M_PI;  // to either side
constexpr double kWall_m = 0.3;            // to the right of the lidar

/// A sweep from the origin, ahead along x, beside a wall; `seen` says what its beams meet.
template <class Seen>
std::vector<Beam> sweep(Seen seen) {
  std::vector<Beam> beams;
  for (double angle_rad = -kSees_rad; angle_rad <= kSees_rad; angle_rad += 0.01) {
    const Vector2 course(std::cos(angle_rad), std::sin(angle_rad));
    const double range_m = seen(course);
    const bool hit = range_m < 5.0;
    const Vector2 end = std::min(range_m, 5.0) * course;
    beams.push_back(
        {Vector3::Zero(), {end.x(), end.y(), 0.0}, hit ? BeamEnd::kHit : BeamEnd::kMiss, 0.0});
  }
  return beams;
}

double to_wall_m(const Vector2& course) {
  return course.y() < 0.0 ? kWall_m / -course.y() : std::numeric_limits<double>::infinity();
}

TEST(BlindWall, GoesOnWhereTheLidarDoesNotSee) {
  const auto walls = blind_walls(sweep(to_wall_m));
  ASSERT_EQ(walls.size(), 1u);
  EXPECT_TRUE(walls[0].hides({-1.0, -kWall_m - 0.001}));
  EXPECT_TRUE(walls[0].hides({-2.0, -1.0})) << "behind it";
  EXPECT_FALSE(walls[0].hides({-1.0, -kWall_m + 0.001})) << "before it";
  EXPECT_FALSE(walls[0].hides({0.0, -1.0})) << "beside what was seen";
}

TEST(BlindWall, IsAtEitherEnd) {
  const auto walls =
      blind_walls(sweep([](const Vector2& course) { return kWall_m / std::abs(course.y()); }));
  ASSERT_EQ(walls.size(), 2u);
  for (const double side : {1.0, -1.0}) {
    const Vector2 behind(-1.0, side * (kWall_m + 0.001));
    EXPECT_NE(walls[0].hides(behind), walls[1].hides(behind));
  }
  for (const BlindWall& wall : walls) EXPECT_FALSE(wall.hides({-1.0, 0.0})) << "between them";
}

TEST(BlindWall, IsTheSameInAClockwiseSweep) {
  std::vector<Beam> clockwise = sweep(to_wall_m);
  std::reverse(clockwise.begin(), clockwise.end());
  const auto walls = blind_walls(clockwise);
  ASSERT_EQ(walls.size(), 1u);
  const BlindWall expected = blind_walls(sweep(to_wall_m)).front();
  EXPECT_LT((walls[0].end - expected.end).norm(), 1e-9);
  EXPECT_LT((walls[0].along - expected.along).norm(), 1e-6);
  EXPECT_LT((walls[0].behind - expected.behind).norm(), 1e-6);
}

TEST(BlindWall, IsSeenThoughTheLastBeamsAreMissing) {
  auto beams = sweep(to_wall_m);
  for (int i = 0; i < 5; ++i) beams[i].kind = BeamEnd::kMiss;
  EXPECT_EQ(blind_walls(beams).size(), 1u);
  for (int i = 0; i < 15; ++i) beams[i].kind = BeamEnd::kMiss;
  EXPECT_TRUE(blind_walls(beams).empty()) << "it ends where it is seen";
}

TEST(BlindWall, GoesOnStraightThoughBeamsAreNoisy) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 0.005);  // of smoothed ranges
  for (int i = 0; i < 200; ++i) {
    const auto walls = blind_walls(
        sweep([&](const Vector2& course) { return to_wall_m(course) + noise(random); }));
    ASSERT_EQ(walls.size(), 1u);
    EXPECT_TRUE(walls[0].hides({-0.5, -kWall_m - 0.05}));
    EXPECT_FALSE(walls[0].hides({-0.5, -kWall_m + 0.05}));
    EXPECT_TRUE(walls[0].hides({-1.2, -kWall_m - 0.15}));
    EXPECT_FALSE(walls[0].hides({-1.2, -kWall_m + 0.15}));
  }
}

TEST(BlindWall, IsMoreThanAPost) {
  const auto post = [](const Vector2& course) {
    const bool meets = std::abs(std::atan2(course.y(), course.x()) + kSees_rad) < 0.1;
    return meets ? 0.5 : std::numeric_limits<double>::infinity();
  };
  EXPECT_TRUE(blind_walls(sweep(post)).empty());
  EXPECT_TRUE(blind_walls({}).empty());
  EXPECT_TRUE(blind_walls(sweep([](const Vector2&) { return 10.0; })).empty());
}

TEST(BlindWall, EndsWhereTheSurfaceDoes) {
  const auto step = [](const Vector2& course) {
    const double range_m = to_wall_m(course);
    return range_m * course.x() < -0.25 ? range_m : 2.0 * range_m;
  };
  EXPECT_TRUE(blind_walls(sweep(step)).empty()) << "5 cm of wall, and another one beyond";
}

}  // namespace
}  // namespace mocha
