#include "trajectory/separation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fleet/protocol/motions.h"

namespace mocha {
namespace {

double distance(const Motion& a, const Motion& b, double t) {
  return (a.at(t).pose.position - b.at(t).pose.position).norm();
}

TEST(Separation, OfCrossingStraightDrivesIsKnown) {
  // Mirror images: at every moment both are equally far from the crossing.
  const Motion a = test::drive(0.0, {{-2.0, 0.0}, {2.0, 0.0}}, 1.0);
  const Motion b = test::drive(0.0, {{0.0, -2.0}, {0.0, 2.0}}, 1.0);
  const ClosestApproach closest = closest_approach(a, b, 0.0, 10.0);
  EXPECT_LE(closest.distance_m, 1e-3);
  EXPECT_NEAR(closest.time_s, 2.0, 0.01);
  const auto first = first_time_closer_than(a, b, 1.0, 0.0);
  ASSERT_TRUE(first);
  EXPECT_LT(*first, 2.0);
  EXPECT_NEAR(distance(a, b, *first), 1.0, 1e-3);
  EXPECT_FALSE(first_time_closer_than(a, b, 1.0, 3.0));
}

TEST(Separation, AgreesWithDenseSampling) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 100; ++trial) {
    const Motion a = test::random_drive(random, 0.0, 4, 3.0);
    const Motion b = test::random_drive(random, 1.5, 6, 3.0);
    const double until = std::max(a.end_time(), b.end_time());
    double sampled = 1e9;
    double sampled_first = 1e9;
    constexpr double kDistance = 0.8;
    for (double t = 0.2; t <= until + 0.01; t += 1e-3) {
      const double d = distance(a, b, t);
      sampled = std::min(sampled, d);
      if (d < kDistance) sampled_first = std::min(sampled_first, t);
    }
    const ClosestApproach closest = closest_approach(a, b, 0.2, 1e3);
    EXPECT_LE(closest.distance_m, sampled + 1e-3) << trial;
    EXPECT_GE(closest.distance_m, sampled - 0.01) << trial;
    EXPECT_NEAR(distance(a, b, closest.time_s), closest.distance_m, 1e-9);
    const auto first = first_time_closer_than(a, b, kDistance, 0.2);
    EXPECT_EQ(first.has_value(), closest.distance_m < kDistance + 5e-4) << trial;
    if (!first) continue;
    EXPECT_LE(*first, sampled_first) << trial;
    EXPECT_LT(distance(a, b, *first), kDistance + 1e-3) << trial;
  }
}

TEST(Separation, WhatIsFarApartByItsBoxesIs) {
  std::mt19937 random(12);
  int told = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Motion a = test::random_drive(random, 0.0, 3, 1.0);
    const Motion b = test::random_drive(random, 1.5, 2, 5.0);
    for (int i = 0; i <= 100; ++i) {
      const double t = a.start_time() + 0.01 * i * (a.end_time() - a.start_time());
      EXPECT_LE(a.box().exteriorDistance(a.position(t)), 1e-9);
    }
    if (!far_apart(a, b, 0.8)) continue;
    ++told;
    EXPECT_GT(closest_approach(a, b, 0.0, 1e3).distance_m, 0.8);
  }
  EXPECT_GT(told, 5);
  EXPECT_TRUE(far_apart(test::stand(0.0, {0.0, 0.0}), test::stand(0.0, {0.81, 0.0}), 0.8));
  EXPECT_FALSE(far_apart(test::stand(0.0, {0.0, 0.0}), test::stand(0.0, {0.8, 0.0}), 0.8));
}

TEST(Separation, FindsATouchBetweenSamples) {
  // Passes a standing robot at 15 m/s: within 0.3 m for 40 ms only, grazing by a millimetre.
  const Motion fast = test::drive(0.0, {{-30.0, 0.299}, {30.0, 0.299}}, 15.0);
  const Motion still = test::stand(0.0, {0.0, 0.0});
  EXPECT_TRUE(first_time_closer_than(fast, still, 0.3, 0.0));
  EXPECT_FALSE(first_time_closer_than(fast, still, 0.298, 0.0));
  EXPECT_NEAR(closest_approach(fast, still, 0.0, 10.0).distance_m, 0.299, 1e-3);
}

TEST(Separation, BothStandBeforeTheirStartAndAfterTheirEnd) {
  const Motion a = test::drive(5.0, {{0.0, 0.0}, {4.0, 0.0}}, 1.0);
  const Motion b = test::stand(0.0, {4.0, 1.0});
  constexpr double kForever = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(closest_approach(a, b, 0.0, 5.0).distance_m, std::hypot(4.0, 1.0), 1e-3);
  EXPECT_NEAR(closest_approach(a, b, 0.0, kForever).distance_m, 1.0, 1e-3);
  EXPECT_NEAR(closest_approach(a, b, 100.0, kForever).distance_m, 1.0, 1e-9);
  EXPECT_EQ(first_time_closer_than(a, b, 1.5, 100.0), 100.0);
  EXPECT_FALSE(first_time_closer_than(a, b, 0.9, 100.0));
  EXPECT_FALSE(first_time_closer_than(a, b, 1.5, 0.0, 5.0));
}

TEST(Separation, WorksAtTimesOfAWallClock) {
  constexpr double kNow = 1.75e9;
  const Motion a = test::drive(kNow, {{-2.0, 0.0}, {2.0, 0.0}}, 1.0);
  const Motion b = test::drive(kNow, {{-3.0, 0.0}, {1.0, 0.0}}, 1.0);  // a convoy one metre apart
  EXPECT_NEAR(closest_approach(a, b, kNow, kNow + 10.0).distance_m, 1.0, 1e-3);
  EXPECT_FALSE(first_time_closer_than(a, b, 0.999, kNow));
  EXPECT_TRUE(first_time_closer_than(a, b, 1.0, kNow));
}

TEST(Separation, BoundsHoldAndAreClose) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 50; ++trial) {
    const Motion motion = test::random_drive(random, 0.0, 5, 4.0);
    const MotionBounds bound = bounds(motion);
    double speed = 0.0;
    double acceleration = 0.0;
    for (double t = 0.0; t < motion.end_time(); t += 0.005) {
      speed = std::max(speed, motion.at(t).velocity.norm());
      acceleration = std::max(acceleration, motion.at(t).acceleration.norm());
    }
    EXPECT_LE(speed, bound.speed);
    EXPECT_LE(acceleration, bound.acceleration);
    EXPECT_LE(bound.speed, 3.0 * speed);
    EXPECT_LE(bound.acceleration, 4.0 * acceleration);
  }
}

TEST(Separation, RefusesEmptyMotionsAndBadRanges) {
  const Motion a = test::stand(0.0, {0.0, 0.0});
  EXPECT_THROW(closest_approach(a, Motion(), 0.0, 1.0), std::invalid_argument);
  EXPECT_THROW(closest_approach(a, a, 1.0, 0.0), std::invalid_argument);
  const double nan = std::nan("");
  EXPECT_THROW(first_time_closer_than(a, a, nan, 0.0, 1.0), std::invalid_argument);
  EXPECT_THROW(first_time_closer_than(a, a, 1.0, nan, 1.0), std::invalid_argument);
  EXPECT_THROW(first_time_closer_than(a, a, 1.0, 0.0, nan), std::invalid_argument);
  EXPECT_FALSE(first_time_closer_than(a, a, 1.0, 1.0, 0.0));
  EXPECT_FALSE(first_time_closer_than(a, a, -1.0, 0.0, 1.0));
}

}  // namespace
}  // namespace mocha
