#include "topology/static_map/travel_cost.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "topology/grid_world.h"
#include "topology/shipped_options.h"
#include "topology/static_map/primitive_static_map.h"

namespace mocha {
namespace {

constexpr double kInfinity = TravelCost::kInfinity;

std::shared_ptr<const StaticMap> circles(const std::vector<Obstacle>& obstacles) {
  return std::make_shared<PrimitiveStaticMap>(
      std::make_shared<PrimitiveField<2>>(obstacles, 2.0),
      Eigen::AlignedBox2d(Vector2(0.0, 0.0), Vector2(10.0, 10.0)));
}

TEST(TravelCost, IsOneInTheOpenAndMoreWhereItIsNarrow) {
  const auto static_map = circles({Circle{{5.0, 5.0}, 1.0}});
  const TravelOptions options = shipped_travel_options();
  const TravelCost cost(*static_map, {1.0, 1.0}, {}, options);
  EXPECT_EQ(cost.at({5.0, 7.0}), 1.0);
  EXPECT_EQ(cost.at({5.0, 6.61}), 1.0);
  const double lack = 1.0 - 0.4 / 0.6;
  EXPECT_NEAR(cost.at({5.0, 6.4}), 1.0 + 3.0 * lack * lack, 1e-12);
  EXPECT_EQ(cost.at({5.0, 6.29}), kInfinity);
  EXPECT_EQ(cost.at({5.0, 5.0}), kInfinity);
}

TEST(TravelCost, CountsThatNarrowPlacesAreDrivenSlowly) {
  const auto static_map = circles({Circle{{5.0, 5.0}, 1.0}});
  TravelOptions options = shipped_travel_options();
  options.preferred_clearance_m = 0.0;
  options.room_for_speed_m = 0.1;
  options.slowest_share = 0.2;
  const TravelCost cost(*static_map, {1.0, 1.0}, {}, options);
  const double required_m = options.required_clearance_m;
  EXPECT_EQ(cost.at({5.0, 6.0 + required_m + 0.101}), 1.0);
  EXPECT_NEAR(cost.at({5.0, 6.0 + required_m + 0.025}), 2.0, 1e-9);
  EXPECT_NEAR(cost.at({5.0, 6.0 + required_m + 0.001}), 5.0, 1e-9);
  EXPECT_EQ(cost.at({5.0, 6.0 + required_m - 0.01}), kInfinity);
}

TEST(TravelCost, OfALineIsTheIntegral) {
  const auto static_map = circles({Circle{{5.0, 5.0}, 1.0}, Circle{{2.0, 7.1}, 0.3}});
  const TravelCost cost(*static_map, {1.0, 1.0}, {}, shipped_travel_options());
  const Vector2 a(0.5, 6.2);
  const Vector2 b(9.0, 6.9);
  double integral = 0.0;
  const int steps = 100000;
  for (int k = 0; k < steps; ++k)
    integral += cost.at(a + (b - a) * ((k + 0.5) / steps)) * (b - a).norm() / steps;
  ASSERT_GT(integral, (b - a).norm() + 0.02);
  EXPECT_NEAR(cost.of_line(a, b), integral, 0.01);
  EXPECT_NEAR(cost.of_line({0.5, 9.0}, {9.5, 9.0}), 9.0, 1e-12);
  EXPECT_EQ(cost.of_line(a, a), 0.0);
}

/// Also where less room is preferred than is required.
TEST(TravelCost, OfALineIsInfiniteExactlyWhereItMeetsAForbiddenPlace) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> coordinate(0.0, 10.0);
  for (const double preferred_m : {0.1, 0.3, 0.6}) {
    TravelOptions options = shipped_travel_options();
    options.preferred_clearance_m = preferred_m;
    int forbidden = 0;
    for (int round = 0; round < 2000; ++round) {
      const auto point = [&] {
        const double x = coordinate(random);
        return Vector2(x, coordinate(random));
      };
      const Circle post{point(), 0.05};
      const auto static_map = circles({post});
      const Vector2 a = point();
      const Vector2 b = point();
      const BlockedDisc disc{point(), 0.4};
      const TravelCost cost(*static_map, {20.0, 20.0}, {disc}, options);
      const double post_m = (nearest_on_segment(post.centre, a, b) - post.centre).norm() - 0.35;
      const double disc_m = (nearest_on_segment(disc.centre, a, b) - disc.centre).norm() - 0.4;
      const double room_m = std::min(post_m, disc_m);
      const bool finite = std::isfinite(cost.of_line(a, b));
      if (room_m < -0.002) {
        EXPECT_FALSE(finite) << room_m;
      }
      if (room_m > 0.0) {
        EXPECT_TRUE(finite) << room_m;
      }
      forbidden += finite ? 0 : 1;
    }
    EXPECT_GT(forbidden, 100);
  }
}

TEST(TravelCost, IsTheSameInBothDirections) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> x(0.0, 8.0);
  std::uniform_real_distribution<double> y(0.0, 6.0);
  const auto static_map = static_map_of(random_world(3, 25, {0.5, 0.5}, {7.5, 5.5}, 0.4));
  const TravelCost cost(*static_map, {0.5, 0.5}, {{{4.0, 3.0}, 0.5}}, shipped_travel_options());
  int finite = 0;
  for (int round = 0; round < 20000; ++round) {
    const Vector2 a(x(random), y(random));
    const Vector2 b(x(random), y(random));
    const double there = cost.of_line(a, b);
    const double back = cost.of_line(b, a);
    ASSERT_EQ(std::isfinite(there), std::isfinite(back)) << a.transpose() << " " << b.transpose();
    if (!std::isfinite(there)) continue;
    ++finite;
    ASSERT_NEAR(there, back, 1e-9);
  }
  EXPECT_GT(finite, 1000);
}

TEST(TravelCost, LetsOneOutOfANarrowPlaceButNotDeeperIn) {
  const auto static_map = circles({Circle{{5.0, 5.0}, 1.0}});
  const TravelOptions options = shipped_travel_options();
  const TravelCost cost(*static_map, {5.0, 6.2}, {}, options);
  EXPECT_TRUE(std::isfinite(cost.at({5.0, 6.2})));
  EXPECT_TRUE(std::isfinite(cost.of_line({5.0, 6.2}, {5.0, 7.0})));
  EXPECT_EQ(cost.at({5.0, 6.15}), kInfinity);
  const double angle = 0.7;  // as close, but beyond the escape radius
  EXPECT_EQ(cost.at(Vector2(5.0, 5.0) + 1.2 * Vector2(std::sin(angle), std::cos(angle))),
            kInfinity);
  const TravelCost inside(*static_map, {5.0, 5.9}, {}, options);
  EXPECT_EQ(inside.at({5.0, 5.9}), kInfinity) << "no robot stands in solid matter";
}

TEST(TravelCost, KeepsOffBlockedDiscsButLetsOneLeaveThem) {
  const auto static_map = circles({});
  const BlockedDisc disc{{5.0, 5.0}, 1.0};
  const TravelCost outside(*static_map, {1.0, 5.0}, {disc}, shipped_travel_options());
  EXPECT_EQ(outside.at({5.0, 5.9}), kInfinity);
  EXPECT_EQ(outside.at({5.0, 6.1}), 1.0) << "discs hold their margins already";
  EXPECT_EQ(outside.of_line({1.0, 5.0}, {9.0, 5.0}), kInfinity);
  const TravelCost within(*static_map, {5.0, 5.5}, {disc}, shipped_travel_options());
  EXPECT_NEAR(within.of_line({5.0, 5.5}, {5.0, 9.0}), 3.5, 1e-9);
  EXPECT_EQ(within.of_line({5.0, 5.5}, {5.0, 1.0}), kInfinity);
}

TEST(TravelCost, PassesOverDiscsOffTheMap) {
  const auto static_map = circles({});
  const BlockedDisc off{{-1.0, 5.0}, 0.9};
  const BlockedDisc overlapping{{-1.0, 5.0}, 1.1};
  const TravelCost cost(*static_map, {1.0, 5.0}, {off, overlapping}, shipped_travel_options());
  ASSERT_EQ(cost.blocked().size(), 1U);
  EXPECT_EQ(cost.blocked().front().radius_m, 1.1);
}

}  // namespace
}  // namespace mocha
