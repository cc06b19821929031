#include "camouflage/adaptive_map.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <stdexcept>

#include "camouflage/camouflage_map.h"

namespace mocha {
namespace {

constexpr double kTravel = 1.2;  // [m]

template <int D>
using Points = typename KnotMap<D>::Knots;

/// Knots along x, whose rays point to the side, with freedoms from 1 to D.
template <int D>
std::vector<RayKnot<D>> ray_knots() {
  std::vector<RayKnot<D>> knots;
  for (int k = 0; k < 5; ++k) {
    typename RayKnot<D>::Vector prey = RayKnot<D>::Vector::Zero();
    typename RayKnot<D>::Vector ray = RayKnot<D>::Vector::Ones();
    prey[0] = k;
    ray[1] = 3.0 - k;
    RayKnot<D> knot = RayKnot<D>::on_ray(prey, ray);
    knot.offset.setLinSpaced(0.3, -0.2);
    knot.freedom = 1 + k % D;
    knot.units_per_m = 0.5 + k;
    knots.push_back(knot);
  }
  return knots;
}

template <int D>
Points<D> placed_by(const KnotMap<D>& map, const Eigen::VectorXd& x) {
  Points<D> knots(D, map.knots());
  Eigen::VectorXd slopes(map.variables());
  map.place(x.data(), knots, slopes);
  return knots;
}

Eigen::VectorXd any_variables(int count) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 1.0);
  return Eigen::VectorXd::NullaryExpr(count, [&] { return noise(random); });
}

TEST(AdaptiveMap, WithOneVariableAKnotMovesAsInCamouflage) {
  Eigen::Matrix2Xd prey(2, 3);
  Eigen::Matrix2Xd references(2, 3);
  prey << 1.0, 2.0, 3.0, 0.0, 0.5, 0.0;
  references << 1.0, 2.5, -10.0, 2.0, -3.0, 50.0;
  std::vector<RayKnot<2>> knots;
  for (int k = 0; k < 3; ++k)
    knots.push_back(RayKnot<2>::on_ray(prey.col(k), prey.col(k) - references.col(k)));
  const AdaptiveMap<2> adaptive(knots, kTravel);
  const CamouflageMap<2> camouflage(prey, references, kTravel);
  EXPECT_EQ(adaptive.parameterisation(), Parameterisation::kCamouflage);
  EXPECT_EQ(adaptive.variables(), 3);
  const Eigen::VectorXd x = any_variables(3);
  EXPECT_LT((placed_by<2>(adaptive, x) - placed_by<2>(camouflage, x)).norm(), 1e-12);
}

template <int D>
void expect_start_and_moves() {
  const std::vector<RayKnot<D>> knots = ray_knots<D>();
  const AdaptiveMap<D> map(knots, kTravel);
  EXPECT_EQ(map.parameterisation(), Parameterisation::kWaypoints);
  int variables = 0;
  const Points<D> start = placed_by<D>(map, map.initial());
  for (int k = 0; k < map.knots(); ++k) {
    EXPECT_LT((start.col(k) - knots[k].position()).norm(), 1e-12);
    EXPECT_EQ(map.variables_of(k), knots[k].freedom);
    variables += knots[k].freedom;
  }
  EXPECT_EQ(map.variables(), variables);
  const Eigen::VectorXd x = any_variables(variables);
  const Points<D> there = placed_by<D>(map, x);
  const std::vector<RayKnot<D>> moved = map.moved(x.data());
  for (int k = 0; k < map.knots(); ++k) {
    EXPECT_LT((there.col(k) - moved[k].position()).norm(), 1e-12);
    const auto step = there.col(k) - start.col(k);
    EXPECT_GT(step.norm(), 1e-6);
    for (int axis = knots[k].freedom; axis < D; ++axis)
      EXPECT_NEAR(step.dot(knots[k].axes.col(axis)), 0.0, 1e-12);
    EXPECT_LT(std::abs(moved[k].offset[0]), kTravel);
  }
  EXPECT_LT((AdaptiveMap<D>(moved, kTravel).initial() - x).norm(), 1e-9);
}

TEST(AdaptiveMap, StartsWhereKnotsAreAndMovesThemAlongTheirAxes) {
  expect_start_and_moves<2>();
  expect_start_and_moves<3>();
}

template <int D>
void expect_slopes() {
  const AdaptiveMap<D> map(ray_knots<D>(), kTravel);
  const Eigen::VectorXd x = any_variables(map.variables());
  Points<D> knots(D, map.knots());
  Eigen::VectorXd slopes(map.variables());
  Eigen::VectorXd by_x(map.variables());
  map.place(x.data(), knots, slopes);
  const Points<D> by_knot = Points<D>::Random(D, map.knots());
  map.pull_back(slopes, by_knot, by_x.data());
  constexpr double kStep = 1e-6;
  for (int i = 0; i < x.size(); ++i) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(x.size(), i);
    const Points<D> change =
        (placed_by<D>(map, x + step) - placed_by<D>(map, x - step)) / (2.0 * kStep);
    EXPECT_NEAR(by_x[i], change.cwiseProduct(by_knot).sum(), 1e-7) << "variable " << i;
  }
}

TEST(AdaptiveMap, PullBackMatchesDifferences) {
  expect_slopes<2>();
  expect_slopes<3>();
}

TEST(AdaptiveMap, AUnitOfAVariableIsAsLongAsItsScaleSays) {
  RayKnot<2> knot = RayKnot<2>::on_ray({0.0, 0.0}, {0.0, 2.0});
  knot.freedom = 2;
  knot.units_per_m = 4.0;
  const AdaptiveMap<2> map({knot}, kTravel);
  constexpr double kStep = 1e-4;
  const Points<2> moved = placed_by<2>(map, Eigen::Vector2d::Constant(kStep));
  EXPECT_NEAR(std::abs(moved(0, 0)), kStep / 4.0, 1e-9);
  EXPECT_NEAR(moved(1, 0), kStep / 4.0, 1e-9);
}

/// As far along the ray as the logistic goes, where it has no inverse in floating point.
TEST(AdaptiveMap, BeginsAgainAtTheEndOfTheTravel) {
  const AdaptiveMap<2> map({RayKnot<2>::on_ray({0.0, 0.0}, {0.0, 1.0})}, kTravel);
  const double far = 1e6;
  const AdaptiveMap<2> again(map.moved(&far), kTravel);
  EXPECT_TRUE(again.initial().allFinite());
  EXPECT_NEAR(placed_by<2>(again, again.initial())(1, 0), kTravel, 1e-5);
}

TEST(RayKnot, IsPromotedAlongTheGradientAndStaysWhereItIs) {
  RayKnot<3> knot = RayKnot<3>::on_ray({1.0, 2.0, 3.0}, {0.0, 0.0, 2.0});
  knot.offset << 0.1, 0.2, 0.3;
  const Eigen::Vector3d place = knot.position();
  const Eigen::Vector3d gradient(3.0, 4.0, 7.0);
  EXPECT_LT((knot.across(gradient) - Eigen::Vector3d(3.0, 4.0, 0.0)).norm(), 1e-12);
  knot.promote(gradient);
  EXPECT_EQ(knot.freedom, 2);
  EXPECT_LT((knot.position() - place).norm(), 1e-12);
  EXPECT_LT((knot.axes.col(1) - Eigen::Vector3d(0.6, 0.8, 0.0)).norm(), 1e-12);
  EXPECT_LT((knot.axes.transpose() * knot.axes - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_LT(knot.across(gradient).norm(), 1e-12) << "one axis more takes all of the gradient";
  EXPECT_NEAR(knot.across({4.0, -3.0, 1.0}).norm(), 5.0, 1e-12);
  knot.promote({4.0, -3.0, 1.0});
  EXPECT_EQ(knot.freedom, 3);
  EXPECT_LT(knot.across({4.0, -3.0, 1.0}).norm(), 1e-12);
  knot.promote(gradient);
  EXPECT_EQ(knot.freedom, 3);
  RayKnot<2> planar = RayKnot<2>::on_ray({0.0, 0.0}, {1.0, 0.0});
  planar.promote({0.0, 0.0});
  EXPECT_EQ(planar.freedom, 2);
}

TEST(AdaptiveMap, RefusesWhatCannotWork) {
  const auto refuses = [](const RayKnot<2>& knot, double travel_m) {
    EXPECT_THROW(AdaptiveMap<2>({knot}, travel_m), std::invalid_argument);
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const RayKnot<2> good = RayKnot<2>::on_ray({0.0, 0.0}, {1.0, 0.0});
  EXPECT_NO_THROW(AdaptiveMap<2>({good}, kTravel));
  refuses(good, 0.0);
  refuses(good, kNan);
  for (const int freedom : {0, 3}) {
    RayKnot<2> bad = good;
    bad.freedom = freedom;
    refuses(bad, kTravel);
  }
  for (const double units_per_m : {0.0, -1.0, kNan}) {
    RayKnot<2> bad = good;
    bad.units_per_m = units_per_m;
    refuses(bad, kTravel);
  }
  RayKnot<2> bad = good;
  bad.prey[0] = kNan;
  refuses(bad, kTravel);
  refuses(RayKnot<2>::on_ray({0.0, 0.0}, {0.0, kNan}), kTravel);
}

}  // namespace
}  // namespace mocha
