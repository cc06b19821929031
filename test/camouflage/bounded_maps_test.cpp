#include "camouflage/bounded_maps.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mocha {
namespace {

TEST(DurationMap, HasThePapersValues) {
  EXPECT_DOUBLE_EQ(duration_of(0.0), 1.0);
  EXPECT_DOUBLE_EQ(duration_of(2.0), 5.0);         // (2 / 2 + 1) 2 + 1
  EXPECT_DOUBLE_EQ(duration_of(-2.0), 1.0 / 5.0);  // 1 / ((-2 / 2 - 1) (-2) + 1)
  EXPECT_DOUBLE_EQ(duration_slope(2.0), 3.0);
  EXPECT_DOUBLE_EQ(duration_slope(-2.0), 3.0 / 25.0);
}

TEST(DurationMap, IsPositiveIncreasingAndSmooth) {
  double last = 0.0;
  for (double eta = -1e3; eta <= 1e3; eta += 0.37) {
    EXPECT_GT(duration_of(eta), last) << "eta = " << eta;
    last = duration_of(eta);
  }
  EXPECT_NEAR(duration_slope(1e-12), duration_slope(-1e-12), 1e-9);  // C1 where its branches meet
}

TEST(DurationMap, SlopeMatchesDifferences) {
  constexpr double kStep = 1e-6;
  for (double eta = -8.05; eta <= 8.0; eta += 0.1) {
    const double slope = (duration_of(eta + kStep) - duration_of(eta - kStep)) / (2.0 * kStep);
    EXPECT_NEAR(duration_slope(eta), slope, 1e-8 * (1.0 + slope)) << "eta = " << eta;
  }
}

TEST(DurationMap, EtaIsTheInverse) {
  for (const double duration_s : {1e-3, 0.01, 0.3, 0.999, 1.0, 1.001, 7.0, 3600.0}) {
    EXPECT_NEAR(duration_of(eta_of(duration_s)), duration_s, 1e-12 * duration_s);
  }
}

TEST(LogisticMap, HasThePapersValuesAtScaleOne) {
  const LogisticMap map{-1.0, 3.0, 1.0};
  EXPECT_DOUBLE_EQ(map.value(0.0), 1.0);
  EXPECT_NEAR(map.value(std::log(3.0)), 2.0, 1e-15);  // sigma = 3/4
  EXPECT_NEAR(map.slope(std::log(3.0)), 4.0 * 3.0 / 16.0, 1e-15);
}

TEST(LogisticMap, StaysInsideItsBoundsForAnyVariable) {
  const LogisticMap map{0.4, 1.6, 2.0};
  double last = map.low;
  for (double xi = -15.0; xi <= 15.0; xi += 0.5) {
    EXPECT_GT(map.value(xi), last);  // strictly inside and increasing
    EXPECT_LT(map.value(xi), map.high);
    last = map.value(xi);
  }
  for (const double xi : {-1e308, -1e4, 1e4, 1e308}) {
    EXPECT_GE(map.value(xi), map.low);
    EXPECT_LE(map.value(xi), map.high);
    EXPECT_EQ(map.slope(xi), 0.0);
  }
}

TEST(LogisticMap, SlopeMatchesDifferencesAndInverseInverts) {
  constexpr double kStep = 1e-6;
  for (const LogisticMap& map :
       {LogisticMap{0.0, 1.0, 1.0}, LogisticMap{0.7, 1.3, 2.0}, LogisticMap{-19.0, 21.0, 0.5}}) {
    for (double xi = -4.0; xi <= 4.0; xi += 0.25) {
      const double slope = (map.value(xi + kStep) - map.value(xi - kStep)) / (2.0 * kStep);
      EXPECT_NEAR(map.slope(xi), slope, 1e-7 * (map.high - map.low));
      EXPECT_NEAR(map.inverse(map.value(xi)), xi, 1e-9);
    }
  }
}

}  // namespace
}  // namespace mocha
