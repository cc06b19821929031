#include "world/moving/prediction.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <random>

#include "world/moving/moving_obstacle.h"

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

/// Share of the true places that a disc of that radius about the predicted one holds after t.
double held_share(const Eigen::Matrix4d& covariance, double radius_m, double t) {
  constexpr int kDraws = 20000;
  const Eigen::Matrix2d root = propagated(covariance, t).llt().matrixL();
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  int held = 0;
  for (int i = 0; i < kDraws; ++i) {
    const Vector2 standard(normal(random), normal(random));
    held += (root * standard).norm() <= radius_m;
  }
  return held / static_cast<double>(kDraws);
}

TEST(PredictedDeviation, HoldsTheThingAsOftenAsNormalErrorsDo) {
  constexpr double kNoise = 0.01;  // three standard deviations of a share
  const PredictionSpread spread = PredictionSpread::normal();
  for (const double confidence : {0.2, 0.5, 0.8, 0.95, 0.97, 0.99}) {
    const double deviations = spread.deviations_at(1.0, confidence);
    const auto radius_m = [&](const Eigen::Matrix4d& covariance, double t) {
      return deviations * PredictedDeviation::of(covariance).after(t);
    };
    // As uncertain in all directions: just so often.
    const Eigen::Matrix4d round = 0.04 * Eigen::Matrix4d::Identity();
    EXPECT_NEAR(held_share(round, radius_m(round, 0.0), 0.0), confidence, kNoise);
    for (int seed = 0; seed < 10; ++seed) {
      const Eigen::Matrix4d covariance = random_covariance(seed);
      for (const double t : {0.0, 0.5, 2.0}) {
        EXPECT_GE(held_share(covariance, radius_m(covariance, t), t), confidence - kNoise)
            << seed << " after " << t;
      }
    }
  }
}

TEST(PredictedDeviation, IsNeverLessThanThePropagatedCovarianceAsksFor) {
  for (int seed = 0; seed < 200; ++seed) {
    const Eigen::Matrix4d covariance = random_covariance(seed);
    const auto deviation = PredictedDeviation::of(covariance);
    for (double t = 0.0; t < 8.0; t += 0.25)
      EXPECT_GE(deviation.after(t), (1.0 - 1e-9) * largest_sigma(propagated(covariance, t)));
    EXPECT_NEAR(deviation.place_m, largest_sigma(propagated(covariance, 0.0)), 1e-9);
  }
}

TEST(PredictedDeviation, OfWhatIsKnownExactlyIsNone) {
  EXPECT_EQ(PredictedDeviation::of(Eigen::Matrix4d::Zero()).after(3.0), 0.0);
}

TEST(PredictedDeviation, TakesWhatIsUncertainInOneDirectionOnly) {
  for (double angle = 0.0; angle < 3.2; angle += 0.01) {
    const Vector2 along(std::cos(angle), std::sin(angle));
    Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
    covariance.topLeftCorner<2, 2>() = 0.09 * along * along.transpose();
    covariance.bottomRightCorner<2, 2>() = 0.01 * along * along.transpose();
    EXPECT_NEAR(PredictedDeviation::of(covariance).place_m, 0.3, 1e-6) << angle;
    EXPECT_NEAR(PredictedDeviation::of(covariance).speed, 0.1, 1e-6) << angle;
  }
}

TEST(PredictedDeviation, RefusesWhatIsNoCovariance) {
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  const Eigen::Matrix4d good = Eigen::Matrix4d::Identity();
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      for (const double value : {nan, infinity, -infinity}) {
        Eigen::Matrix4d bad = good;
        bad(row, column) = value;
        EXPECT_THROW(PredictedDeviation::of(bad), std::invalid_argument) << row << " " << column;
      }
      Eigen::Matrix4d bad = good;
      bad(row, column) = bad(column, row) = row == column ? -0.5 : 2.0;
      EXPECT_THROW(PredictedDeviation::of(bad), std::invalid_argument) << row << " " << column;
    }
  }
  Eigen::Matrix4d lopsided = good;
  lopsided(0, 1) = 0.9;  // and nothing below the diagonal
  EXPECT_THROW(PredictedDeviation::of(lopsided), std::invalid_argument);
}

PredictionSpread known_spread() {
  PredictionSpread spread{{0.5, 1.0}, {0.5, 0.9}, Eigen::MatrixXd(2, 2), Eigen::MatrixXd(2, 2)};
  spread.at << 0.5, 1.5, 1.0, 3.0;
  spread.throughout << 1.0, 2.0, 2.0, 4.0;
  return spread;
}

TEST(PredictionSpread, SaysWhatStandsThereAndGoesOnBetween) {
  const PredictionSpread spread = known_spread();
  EXPECT_NO_THROW(spread.check());
  EXPECT_NEAR(spread.deviations_at(0.5, 0.5), 0.5, 1e-12);
  EXPECT_NEAR(spread.deviations_at(1.0, 0.9), 3.0, 1e-12);
  EXPECT_NEAR(spread.deviations_at(0.75, 0.9), 2.25, 1e-12);
  EXPECT_NEAR(spread.deviations_throughout(0.75, 0.5), 1.5, 1e-12);
  // Outside, the nearest; but nothing is less sure than a confidence of 0.
  EXPECT_NEAR(spread.deviations_at(0.1, 0.9), 1.5, 1e-12);
  EXPECT_NEAR(spread.deviations_at(9.0, 0.99), 3.0, 1e-12);
  EXPECT_EQ(spread.deviations_at(1.0, 0.0), 0.0);
  double last = 0.0;
  for (double confidence = 0.0; confidence < 0.9; confidence += 0.05) {
    EXPECT_GE(spread.deviations_at(0.6, confidence), last) << confidence;
    last = spread.deviations_at(0.6, confidence);
  }
}

TEST(PredictionSpread, RefusesWhatIsNone) {
  const double nan = std::nan("");
  std::vector<PredictionSpread> bad(13, known_spread());
  bad[0].ahead_s = {};
  bad[1].ahead_s = {1.0, 0.5};
  bad[2].ahead_s = {0.0, 0.5};
  bad[3].ahead_s = {0.5, 1e6};
  bad[4].confidences = {0.5, 1.0};
  bad[5].confidences = {0.5, nan};
  bad[6].confidences = {0.5};
  bad[7].at(1, 0) = nan;
  bad[8].at(1, 0) = -0.1;
  bad[9].at(0, 1) = 0.4;
  bad[10].throughout(1, 1) = 1001.0;
  bad[11].throughout.resize(1, 2);
  bad[12].at.resize(0, 0);
  for (std::size_t i = 0; i < bad.size(); ++i)
    EXPECT_THROW(bad[i].check(), std::invalid_argument) << i;
}

PredictedThing thing_at(const Vector2& place, const Vector2& velocity = Vector2::Zero()) {
  return {7, place, velocity, 0.3, {0.01, 0.02}};
}

TEST(ConfidenceOfEach, SharesTheRiskAmongThoseWithinReach) {
  const RiskOptions options{0.2, 1.0, 0.0, 1.0, 0.0};
  Predictions predictions{5.0};
  EXPECT_NEAR(confidence_of_each(predictions, Vector2::Zero(), options), 0.8, 1e-12);
  predictions.things = {thing_at({1.0, 0.0})};
  EXPECT_NEAR(confidence_of_each(predictions, Vector2::Zero(), options), 0.8, 1e-12);
  predictions.things = {thing_at({1.0, 0.0}), thing_at({0.0, 1.2}), thing_at({0.0, -1.2}),
                        thing_at({2.0, 0.0}, {-1.0, 0.0})};
  EXPECT_NEAR(confidence_of_each(predictions, Vector2::Zero(), options), 0.95, 1e-12);
  predictions.things.push_back(thing_at({2.0, 0.0}));  // too far and slow to be met
  EXPECT_NEAR(confidence_of_each(predictions, Vector2::Zero(), options), 0.95, 1e-12);
  RiskOptions larger = options;  // but by a larger robot
  larger.robot_radius_m = 1.0;
  EXPECT_NEAR(confidence_of_each(predictions, Vector2::Zero(), larger), 0.96, 1e-12);
}

TEST(ConfidentDiscs, LeaveOutWhatTheClearanceHolds) {
  const Predictions predictions{5.0, {thing_at({1.0, 2.0})}, known_spread()};
  const Discs confident = confident_discs(predictions, 0.9, {0.1, 1.0, 0.05, 1.0, 0.0});
  EXPECT_NEAR(confident[0]->at(5.0).radius_m, 0.3, 1e-12);  // 4 * 0.01 is within the clearance
  EXPECT_NEAR(confident[0]->at(6.0).radius_m, 0.3 + 4.0 * 0.03 - 0.05, 1e-12);
}

TEST(ConfidentDiscs, GrowAsTheSpreadSays) {
  Predictions predictions{5.0, {thing_at({1.0, 2.0}, {0.5, 0.0})}, known_spread()};
  const Discs confident = confident_discs(predictions, 0.9, {0.1, 1.0, 0.0, 1.0, 0.0});
  ASSERT_EQ(confident.size(), 1u);
  EXPECT_EQ(confident[0]->name(), "moving thing 7");
  EXPECT_NEAR(confident[0]->at(5.0).radius_m, 0.3 + 4.0 * 0.01, 1e-12);
  EXPECT_NEAR(confident[0]->at(6.0).radius_m, 0.3 + 4.0 * 0.03, 1e-12);
  EXPECT_NEAR(confident[0]->at(9.0).radius_m, 0.3 + 4.0 * 0.03, 1e-12);
  EXPECT_EQ(confident[0]->at(7.0).centre, Vector2(2.0, 2.0));
  const Discs likely = likely_discs(predictions);
  ASSERT_EQ(likely.size(), 1u);
  EXPECT_EQ(likely[0]->at(9.0).radius_m, 0.3);
  EXPECT_EQ(likely[0]->at(7.0).centre, Vector2(2.0, 2.0));
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
