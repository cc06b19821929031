#include "perception/tracking/fading_quantiles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace mocha {
namespace {

constexpr FadingQuantiles::Prior kPrior{1.0, 0.5, 100.0};
constexpr double kBin = 0.065;  // width of a bin of the histogram, relative

TEST(FadingQuantiles, BeginsWithThePrior) {
  const FadingQuantiles quantiles(300.0, kPrior);
  EXPECT_NEAR(quantiles.quantile(0.5), 1.0, kBin);
  EXPECT_NEAR(quantiles.quantile(0.8413), std::exp(0.5), kBin * std::exp(0.5));
  EXPECT_NEAR(quantiles.quantile(0.1587), std::exp(-0.5), kBin);
}

TEST(FadingQuantiles, LearnsWhatComes) {
  FadingQuantiles quantiles(300.0, kPrior);
  std::mt19937 random(1);
  std::exponential_distribution<double> value(0.5);
  for (int i = 0; i < 3000; ++i) quantiles.add(value(random));
  for (const double share : {0.2, 0.5, 0.8, 0.95})
    EXPECT_NEAR(quantiles.quantile(share), -2.0 * std::log(1.0 - share), 0.35) << share;
}

TEST(FadingQuantiles, ForgetsWhatWas) {
  FadingQuantiles quantiles(100.0, kPrior);
  for (int i = 0; i < 1000; ++i) quantiles.add(5.0);
  EXPECT_NEAR(quantiles.quantile(0.5), 5.0, 5.0 * kBin);
  for (int i = 0; i < 60; ++i) quantiles.add(0.5);
  EXPECT_NEAR(quantiles.quantile(0.6), 5.0, 5.0 * kBin);  // 0.55 of the weight is old
  for (int i = 0; i < 60; ++i) quantiles.add(0.5);
  EXPECT_NEAR(quantiles.quantile(0.6), 0.5, 0.5 * kBin);
}

TEST(FadingQuantiles, WhatIsOutsideCountsAsTheOutermost) {
  FadingQuantiles quantiles(100.0, kPrior);
  for (int i = 0; i < 2000; ++i) quantiles.add(0.0);
  EXPECT_NEAR(quantiles.quantile(0.99), 0.02, 0.02 * kBin);
  for (int i = 0; i < 2000; ++i) quantiles.add(1e9);
  EXPECT_NEAR(quantiles.quantile(0.01), 50.0, 50.0 * kBin);
  EXPECT_LE(quantiles.quantile(0.999), 50.0);
}

TEST(FadingQuantiles, RefusesWhatIsNoMemory) {
  EXPECT_THROW(FadingQuantiles(0.5, kPrior), std::invalid_argument);
  EXPECT_THROW(FadingQuantiles(std::nan(""), kPrior), std::invalid_argument);
  EXPECT_THROW(FadingQuantiles(10.0, {0.0, 0.5, 1.0}), std::invalid_argument);
  EXPECT_THROW(FadingQuantiles(10.0, {1.0, 0.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(FadingQuantiles(10.0, {1.0, 0.5, -1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace mocha
