#include "camouflage/camouflage_map.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <stdexcept>

namespace mocha {
namespace {

template <int D>
using Knots = typename KnotMap<D>::Knots;

constexpr double kTravel_m = 1.2;

/// Prey along x with references from 5 cm to 50 m away.
template <int D>
struct Example {
  Knots<D> prey = Knots<D>::Zero(D, 4);
  Knots<D> references = Knots<D>::Zero(D, 4);
  Example() {
    prey.row(0) << 1.0, 2.0, 3.0, 4.0;
    references.row(0) << 1.03, 2.5, 3.0, -10.0;
    references.row(1) << 0.04, -3.0, 5.0, 50.0;
    if (D == 3) references.row(2).setConstant(0.7);
  }
};

template <int D>
Knots<D> placed(const KnotMap<D>& map, const Eigen::VectorXd& xi) {
  Knots<D> knots(D, map.knots());
  Eigen::VectorXd slopes(xi.size());
  map.place(xi.data(), knots, slopes);
  return knots;
}

template <int D>
void expect_camouflage() {
  const Example<D> example;
  const CamouflageMap<D> map(example.prey, example.references, kTravel_m);
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 1.5);
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::VectorXd xi = Eigen::VectorXd::NullaryExpr(4, [&] { return noise(random); });
    const Knots<D> knots = placed<D>(map, xi);
    for (int k = 0; k < 4; ++k) {
      const Eigen::Matrix<double, D, 1> ray = example.prey.col(k) - example.references.col(k);
      const Eigen::Matrix<double, D, 1> expected =
          example.references.col(k) + map.lambda(k, xi[k]) * ray;  // paper (9)
      EXPECT_LT((knots.col(k) - expected).norm(), 1e-12);
      EXPECT_LT((knots.col(k) - example.prey.col(k)).norm(), kTravel_m);
    }
  }
}

TEST(CamouflageMap, PutsKnotsOnTheirRaysWithinTheTravel) {
  expect_camouflage<2>();
  expect_camouflage<3>();
}

TEST(CamouflageMap, StartsOnThePreyPath) {
  const Example<2> example;
  const CamouflageMap<2> map(example.prey, example.references, kTravel_m);
  EXPECT_EQ(map.variables(), 4);
  EXPECT_LT((placed<2>(map, map.initial()) - example.prey).norm(), 1e-12);
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(map.lambda(k, 0.0), 1.0, 1e-12);
}

TEST(CamouflageMap, OneUnitMovesAKnotAboutAMetreWhateverItsLeverage) {
  const Example<2> example;
  for (const double travel_m : {0.3, 1.0, 5.0, 20.0}) {
    const CamouflageMap<2> map(example.prey, example.references, travel_m);
    constexpr double kStep = 1e-4;
    const Knots<2> plus = placed<2>(map, Eigen::VectorXd::Constant(4, kStep));
    for (int k = 0; k < 4; ++k) {
      EXPECT_NEAR((plus.col(k) - example.prey.col(k)).norm() / kStep, 1.0, 1e-3);
    }
  }
}

TEST(CamouflageMap, IsNotSaturatedWhereItIsUsedAndStopsAtTheTravel) {
  const Example<2> example;
  const CamouflageMap<2> map(example.prey, example.references, kTravel_m);
  const Knots<2> half = placed<2>(map, Eigen::VectorXd::Constant(4, 0.5 * kTravel_m));
  const Knots<2> far = placed<2>(map, Eigen::VectorXd::Constant(4, 1e6));
  for (int k = 0; k < 4; ++k) {
    // At half the travel the logistic has gone tanh(1/2) of the way: still close to a metre a unit.
    EXPECT_NEAR((half.col(k) - example.prey.col(k)).norm(), kTravel_m * std::tanh(0.5), 1e-9);
    EXPECT_NEAR((far.col(k) - example.prey.col(k)).norm(), kTravel_m, 1e-9);
  }
}

template <int D>
void expect_pull_back(const KnotMap<D>& map, const Eigen::VectorXd& x) {
  Knots<D> by_knot = Knots<D>::Random(D, map.knots());
  Eigen::VectorXd by_x(map.variables());
  Knots<D> knots(D, map.knots());
  Eigen::VectorXd slopes(map.variables());
  map.place(x.data(), knots, slopes);
  map.pull_back(slopes, by_knot, by_x.data());
  constexpr double kStep = 1e-6;
  for (int i = 0; i < x.size(); ++i) {
    Eigen::VectorXd plus = x;
    Eigen::VectorXd minus = x;
    plus[i] += kStep;
    minus[i] -= kStep;
    const Knots<D> change = (placed<D>(map, plus) - placed<D>(map, minus)) / (2.0 * kStep);
    EXPECT_NEAR(by_x[i], change.cwiseProduct(by_knot).sum(), 1e-7) << "variable " << i;
  }
}

TEST(CamouflageMap, PullBackMatchesDifferences) {
  std::mt19937 random(2);
  std::normal_distribution<double> noise(0.0, 1.0);
  const auto any = [&](int n) -> Eigen::VectorXd {
    return Eigen::VectorXd::NullaryExpr(n, [&] { return noise(random); });
  };
  const Example<2> plane;
  const Example<3> space;
  for (int trial = 0; trial < 10; ++trial) {
    expect_pull_back<2>(CamouflageMap<2>(plane.prey, plane.references, kTravel_m), any(4));
    expect_pull_back<3>(CamouflageMap<3>(space.prey, space.references, kTravel_m), any(4));
    expect_pull_back<2>(WaypointMap<2>(plane.prey), any(8));
    expect_pull_back<3>(WaypointMap<3>(space.prey), any(12));
  }
}

TEST(CamouflageMap, RefusesWhatCannotWork) {
  const Example<2> example;
  const auto refuses = [](const Knots<2>& prey, const Knots<2>& references, double travel_m) {
    EXPECT_THROW(CamouflageMap<2>(prey, references, travel_m), std::invalid_argument);
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  refuses(example.prey, example.references.leftCols(3), kTravel_m);
  refuses(example.prey, example.references, 0.0);
  refuses(example.prey, example.references, -1.0);
  refuses(example.prey, example.references, kNan);
  refuses(example.prey, example.prey, kTravel_m);
  Knots<2> broken = example.references;
  broken(1, 2) = kNan;
  refuses(example.prey, broken, kTravel_m);
  broken(1, 2) = std::numeric_limits<double>::infinity();
  refuses(example.prey, broken, kTravel_m);
}

}  // namespace
}  // namespace mocha
