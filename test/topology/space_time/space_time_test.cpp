#include "topology/space_time/space_time.h"

#include <gtest/gtest.h>

#include <limits>

#include "topology/paths/euclidean_shortcutting.h"
#include "topology/signatures/signature_sums.h"
#include "world/primitive_field.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1000.0;
constexpr double kSpan_s = 5.0;
constexpr double kMaxSpeed = 1.5;

template <int D>
using Place = Eigen::Matrix<double, D, 1>;

template <int D>
struct World {
  PrimitiveField<D> field{{}, 1.0};
  Cuts<D> cuts{{}};
  SpaceTimeEnds<D> ends{-2.0 * Place<D>::UnitY(), 2.0 * Place<D>::UnitX(), kNow_s,
                        kNow_s + kSpan_s};
  std::vector<Tube<D>> tubes;

  SpaceTime<D> space(double max_speed = kMaxSpeed) const {
    return {field, cuts,      {Place<D>::Constant(-9.0), Place<D>::Constant(9.0)}, ends, max_speed,
            tubes, {0.3, 0.6}};
  }
};

template <int D>
void expect_samples_in_reach() {
  const World<D> world;
  const SpaceTime<D> space = world.space();
  std::mt19937_64 random(1);
  Eigen::AlignedBox<double, D + 1> covered;
  Place<D + 1> mean = Place<D + 1>::Zero();
  constexpr int kSamples = 20000;
  for (int i = 0; i < kSamples; ++i) {
    Place<D + 1> shares;
    for (double& share : shares) share = uniform(random, 0.0, 1.0);
    const Place<D + 1> p = space.at(shares);
    const double since_s = p[D] / kMaxSpeed;
    ASSERT_LE((p.template head<D>() - world.ends.start).norm(), kMaxSpeed * since_s + 1e-9);
    ASSERT_LE((p.template head<D>() - world.ends.goal).norm(),
              kMaxSpeed * (kSpan_s - since_s) + 1e-9);
    covered.extend(p);
    mean += p / kSamples;
  }
  EXPECT_LT((mean - 0.5 * (space.start() + space.goal())).norm(), 0.05);
  // Of the ellipse with the ends as foci, most is covered.
  const Place<D> ahead = (world.ends.goal - world.ends.start).normalized();
  const double longest_m = kMaxSpeed * kSpan_s * std::abs(ahead[0]);
  EXPECT_GT(covered.sizes()[0], 0.8 * longest_m);
  EXPECT_GT(covered.sizes()[D], 0.99 * kMaxSpeed * kSpan_s);
}

TEST(SpaceTime, SamplesWhatIsInReach) {
  expect_samples_in_reach<2>();
  expect_samples_in_reach<3>();
}

TEST(SpaceTime, IsInOrderOfTimeAndWithinTheSpeed) {
  const SpaceTime<2> space = World<2>().space();
  const auto at = [&](double x, double t) { return space.point({x, 0.0}, kNow_s + t); };
  EXPECT_TRUE(space.in_order(at(0.0, 1.0), at(1.49, 2.0)));
  EXPECT_TRUE(space.in_order(at(0.0, 1.0), at(0.0, 2.0)));
  EXPECT_TRUE(space.in_order(at(0.0, 1.0), at(1.5, 2.0)));  // just so, though rounded
  EXPECT_FALSE(space.in_order(at(0.0, 1.0), at(1.500001, 2.0)));
  EXPECT_FALSE(space.in_order(at(0.0, 2.0), at(0.0, 1.0)));
  EXPECT_FALSE(space.in_order(at(0.0, 1.0), at(0.0, 1.0)));
  EXPECT_FALSE(space.in_order(at(std::nan(""), 1.0), at(0.0, 2.0)));
  EXPECT_DOUBLE_EQ(space.time_s(at(0.0, 1.25)), kNow_s + 1.25);
}

TEST(SpaceTime, UniformMotionIsShortest) {
  const SpaceTime<2> space = World<2>().space();
  const auto at = [&](double x, double t) { return space.point({x, 0.0}, kNow_s + t); };
  const double uniform_m = space.length_m(at(0.0, 0.0), at(1.0, 2.0));
  const double waiting_m =
      space.length_m(at(0.0, 0.0), at(0.0, 1.0)) + space.length_m(at(0.0, 1.0), at(1.0, 2.0));
  EXPECT_GT(waiting_m, uniform_m + 0.1);
}

TEST(SpaceTime, ForgivesLessAndLessWhatLacksAtTheStart) {
  World<2> world;
  // 0.4 m from the start, which should be 0.7 m. It comes along, so that one may stay beside it.
  world.tubes = {
      {{kNow_s, kNow_s + kSpan_s, world.ends.start + Vector2(0.0, 0.4), {0.0, 0.0}, 0.7, 0.0}}};
  const SpaceTime<2> space = world.space();
  const auto clear = [&](double apart_m, double since_s) {
    const Vector2 place = world.tubes[0][0].centre - Vector2(0.0, apart_m);
    return space.clearance_m(space.point(place, kNow_s + since_s)).has_value();
  };
  EXPECT_TRUE(clear(0.4, 0.0));
  EXPECT_FALSE(clear(0.39, 0.0));
  EXPECT_TRUE(clear(0.55, 1.0));
  EXPECT_FALSE(clear(0.54, 1.0));
  EXPECT_FALSE(clear(0.69, 2.1));
  EXPECT_TRUE(clear(0.71, 2.1));
  EXPECT_FALSE(clear(0.69, 4.0));
  EXPECT_TRUE(clear(0.71, 4.0));
}

TEST(SpaceTime, WhatIsNoMoreCanBePassedOnEitherSide) {
  World<2> world;
  world.ends.start = {-2.0, 0.0};
  world.ends.goal = {2.0, 0.0};
  world.tubes = {{{kNow_s, kNow_s + 2.0, {1.0, 0.0}, {0.0, 0.0}, 0.5, 0.0}}};
  const SpaceTime<2> space = world.space();
  const auto key = [&](const Vector2& early, const Vector2& late) {
    const std::vector<Eigen::Vector3d> path = {space.start(), space.point(early, kNow_s + 2.0),
                                               space.point(late, kNow_s + 3.0), space.goal()};
    return sum_of_keys(space.signature_of(path));
  };
  EXPECT_EQ(key({-1.0, 0.1}, {1.0, 0.5}), key({-1.0, 0.1}, {1.0, -0.5}));
  EXPECT_NE(key({-1.0, 0.1}, {1.0, 0.5}), key({-1.0, -0.1}, {1.0, 0.5}));
}

TEST(SpaceTime, RefusesWhatMakesNoSense) {
  World<2> world;
  EXPECT_THROW(world.space(0.0), std::invalid_argument);
  EXPECT_THROW(world.space(std::nan("")), std::invalid_argument);
  world.ends.goal_s = kNow_s;
  EXPECT_THROW(world.space(), std::invalid_argument);
  world.ends.goal_s = std::numeric_limits<double>::infinity();
  EXPECT_THROW(world.space(), std::invalid_argument);
  world.ends.goal_s = kNow_s + 1.0;
  world.ends.goal.x() = std::nan("");
  EXPECT_THROW(world.space(), std::invalid_argument);
}

TEST(EuclideanShortcutting, GoesStraightToWhereItHasToBend) {
  World<2> world;
  world.ends.start = {-2.0, 0.0};
  world.ends.goal = {2.0, 0.0};
  world.field = PrimitiveField<2>({Circle{{0.0, 0.0}, 0.5}}, 1.0);
  world.cuts = Cuts<2>({Vector2(0.0, 0.0)});
  const SpaceTime<2> space = world.space();
  std::mt19937_64 random(1);
  // Round a disc of 0.8 m: two tangents and an arc.
  const double arc_rad = M_PI - 2.0 * std::acos(0.8 / 2.0);
  const double least_m = 2.0 * std::sqrt(4.0 - 0.64) + 0.8 * arc_rad;
  for (const double side : {-1.0, 1.0}) {
    std::vector<Eigen::Vector3d> path = {space.start()};
    for (int i = 1; i < 10; ++i) {
      const double x = -2.0 + 0.4 * i + uniform(random, -0.05, 0.05);
      const double y = side * (1.4 - 0.25 * x * x + uniform(random, -0.05, 0.05));
      path.push_back(space.point({x, y}, kNow_s + 0.5 * i));
    }
    path.push_back(space.goal());
    const auto shorter = with_shortcuts<3>(path, space);
    EXPECT_EQ(space.signature_of(shorter), space.signature_of(path));
    EXPECT_LT(shorter.size(), path.size());
    double length_m = 0.0;
    for (std::size_t i = 1; i < shorter.size(); ++i) {
      ASSERT_TRUE(space.in_order(shorter[i - 1], shorter[i]));
      ASSERT_TRUE(space.clearance_m(shorter[i - 1], shorter[i]));
      length_m += (shorter[i] - shorter[i - 1]).head<2>().norm();
    }
    EXPECT_GE(length_m, least_m - 1e-6);
    EXPECT_LT(length_m, 1.02 * least_m);
  }
}

}  // namespace
}  // namespace mocha
