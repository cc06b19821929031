#include "world/prediction.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <random>

#include "world/moving_obstacle.h"

namespace mocha {
namespace {

/// Of a state whose place and velocity have much in common, as a filter says after a few
/// detections.
Eigen::Matrix4d random_covariance(int seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Eigen::Matrix4d root;
  for (double& value : root.reshaped()) value = 0.2 * normal(random);
  return root * root.transpose();
}

/// Of the place, propagated at constant velocity.
Eigen::Matrix2d propagated(const Eigen::Matrix4d& covariance, double t) {
  Eigen::Matrix<double, 2, 4> step;
  step << 1.0, 0.0, t, 0.0, 0.0, 1.0, 0.0, t;
  return step * covariance * step.transpose();
}

double largest_sigma(const Eigen::Matrix2d& covariance) {
  return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(covariance).eigenvalues()[1]);
}

/// Share of the true places that a disc about the predicted one holds after t.
double held_share(const Eigen::Matrix4d& covariance, const RadiusGrowth& growth, double t) {
  constexpr int kDraws = 20000;
  const Eigen::Matrix2d root = propagated(covariance, t).llt().matrixL();
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  int held = 0;
  for (int i = 0; i < kDraws; ++i) {
    const Vector2 standard(normal(random), normal(random));
    held += (root * standard).norm() <= growth.radius_m + growth.rate * t;
  }
  return held / static_cast<double>(kDraws);
}

TEST(GrowthOf, HoldsTheThingAsOftenAsAskedFor) {
  constexpr double kNoise = 0.01;  // three standard deviations of a share
  for (const double confidence : {0.2, 0.5, 0.8, 0.95, 0.99}) {
    // As uncertain in all directions: just so often.
    const Eigen::Matrix4d round = 0.04 * Eigen::Matrix4d::Identity();
    EXPECT_NEAR(held_share(round, growth_of(round, confidence), 0.0), confidence, kNoise);
    for (int seed = 0; seed < 10; ++seed) {
      const Eigen::Matrix4d covariance = random_covariance(seed);
      for (const double t : {0.0, 0.5, 2.0}) {
        EXPECT_GE(held_share(covariance, growth_of(covariance, confidence), t), confidence - kNoise)
            << seed << " after " << t;
      }
    }
  }
}

TEST(GrowthOf, IsNeverLessThanThePropagatedCovarianceAsksFor) {
  for (int seed = 0; seed < 200; ++seed) {
    const Eigen::Matrix4d covariance = random_covariance(seed);
    const RadiusGrowth growth = growth_of(covariance, 1.0 - std::exp(-0.5));  // one deviation
    for (double t = 0.0; t < 8.0; t += 0.25) {
      EXPECT_GE(growth.radius_m + growth.rate * t,
                (1.0 - 1e-9) * largest_sigma(propagated(covariance, t)));
    }
    EXPECT_NEAR(growth.radius_m, largest_sigma(propagated(covariance, 0.0)), 1e-9);
  }
}

TEST(GrowthOf, WhatIsKnownExactlyDoesNotGrow) {
  EXPECT_EQ(growth_of(Eigen::Matrix4d::Zero(), 0.99).radius_m, 0.0);
  EXPECT_EQ(growth_of(Eigen::Matrix4d::Zero(), 0.99).rate, 0.0);
  EXPECT_EQ(growth_of(Eigen::Matrix4d::Identity(), 0.0).radius_m, 0.0);
}

TEST(GrowthOf, TakesWhatIsUncertainInOneDirectionOnly) {
  for (double angle = 0.0; angle < 3.2; angle += 0.01) {
    const Vector2 along(std::cos(angle), std::sin(angle));
    Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
    covariance.topLeftCorner<2, 2>() = 0.09 * along * along.transpose();
    covariance.bottomRightCorner<2, 2>() = 0.01 * along * along.transpose();
    const RadiusGrowth growth = growth_of(covariance, 1.0 - std::exp(-0.5));
    EXPECT_NEAR(growth.radius_m, 0.3, 1e-6) << angle;
    EXPECT_NEAR(growth.rate, 0.1, 1e-6) << angle;
  }
}

TEST(GrowthOf, RefusesWhatIsNone) {
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  const Eigen::Matrix4d good = Eigen::Matrix4d::Identity();
  for (const double confidence : {-0.1, 1.0, 1.5, nan, infinity})
    EXPECT_THROW(growth_of(good, confidence), std::invalid_argument) << confidence;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      for (const double value : {nan, infinity, -infinity}) {
        Eigen::Matrix4d bad = good;
        bad(row, column) = value;
        EXPECT_THROW(growth_of(bad, 0.8), std::invalid_argument) << row << " " << column;
      }
      Eigen::Matrix4d bad = good;
      bad(row, column) = bad(column, row) = row == column ? -0.5 : 2.0;
      EXPECT_THROW(growth_of(bad, 0.8), std::invalid_argument) << row << " " << column;
    }
  }
  Eigen::Matrix4d lopsided = good;
  lopsided(0, 1) = 0.9;  // and nothing below the diagonal
  EXPECT_THROW(growth_of(lopsided, 0.8), std::invalid_argument);
}

TEST(PredictedDisc, GrowsForAWhileOnly) {
  const PredictedDisc disc("person", 5.0, {1.0, 2.0}, {0.6, -0.8}, 0.25, 0.1, 2.0);
  EXPECT_NEAR(disc.at(4.0).radius_m, 0.25, 1e-12);
  EXPECT_EQ(disc.at(4.0).radius_rate, 0.0);
  EXPECT_NEAR(disc.at(6.0).radius_m, 0.35, 1e-12);
  EXPECT_EQ(disc.at(6.0).radius_rate, 0.1);
  EXPECT_NEAR(disc.at(7.0).radius_m, 0.45, 1e-12);
  EXPECT_NEAR(disc.at(70.0).radius_m, 0.45, 1e-12);
  EXPECT_EQ(disc.at(70.0).radius_rate, 0.0);
  EXPECT_NEAR(disc.max_closing_speed(6.9), 1.1, 1e-12);
  EXPECT_NEAR(disc.max_closing_speed(7.1), 1.0, 1e-12);
  EXPECT_THROW(PredictedDisc("a", 0.0, {0, 0}, {0, 0}, 0.1, 0.1, -1.0), std::invalid_argument);
  EXPECT_THROW(PredictedDisc("a", 0.0, {0, 0}, {0, 0}, 0.1, 0.1, std::nan("")),
               std::invalid_argument);
}

/// How far it sticks out of one that moves and grows uniformly from one time to the other.
double sampled_chord_error_m(const PredictedDisc& disc, double from_s, double until_s) {
  const MovingObstacle::Disc begin = disc.at(from_s);
  const MovingObstacle::Disc end = disc.at(until_s);
  double error_m = 0.0;
  for (double share = 0.0; share <= 1.0; share += 1e-3) {
    const MovingObstacle::Disc there = disc.at(from_s + share * (until_s - from_s));
    const Vector2 centre = begin.centre + share * (end.centre - begin.centre);
    const double radius_m = begin.radius_m + share * (end.radius_m - begin.radius_m);
    error_m = std::max(error_m, (there.centre - centre).norm() + there.radius_m - radius_m);
  }
  return error_m;
}

TEST(PredictedDisc, ChordErrorIsABoundAndATightOneWhereItGrows) {
  const PredictedDisc disc("person", 5.0, {1.0, 2.0}, {0.6, -0.8}, 0.25, 0.4, 2.0);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> time(3.0, 10.0);
  for (int i = 0; i < 300; ++i) {
    double from_s = time(random);
    double until_s = time(random);
    if (until_s < from_s) std::swap(from_s, until_s);
    const double sampled_m = sampled_chord_error_m(disc, from_s, until_s);
    EXPECT_GE(disc.chord_error_m(from_s, until_s), sampled_m - 1e-9) << from_s << " " << until_s;
    if (from_s >= 5.0) {
      EXPECT_NEAR(disc.chord_error_m(from_s, until_s), sampled_m, 2e-3);
    }
  }
  EXPECT_EQ(disc.chord_error_m(5.0, 7.0), 0.0);
  EXPECT_EQ(PredictedDisc("b", 5.0, {0, 0}, {1, 0}, 0.2, 0.4).chord_error_m(0.0, 99.0), 0.0);
}

}  // namespace
}  // namespace mocha
