#include "trajectory/braking.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace mocha {
namespace {

TEST(Braking, TakesWhatTheFrictionCircleLeaves) {
  const Braking braking(0.6, 1.0);
  EXPECT_EQ(braking.beside(0.0), 0.6);
  EXPECT_EQ(braking.beside(0.7), 0.6);
  EXPECT_NEAR(braking.beside(0.9), std::sqrt(1.0 - 0.81), 1e-12);
  EXPECT_EQ(braking.beside(1.0), 0.15);
  EXPECT_EQ(braking.beside(5.0), 0.15);
  EXPECT_EQ(Braking(0.6).beside(5.0), 0.6);
}

TEST(Braking, RampsFromThePresentAcceleration) {
  const Braking braking(0.6, 1.0);
  EXPECT_NEAR(braking.rate(0.4, 0.0, 0.0), 0.4, 1e-12);
  EXPECT_NEAR(braking.rate(0.4, 0.5, 0.0), -0.1, 1e-12);
  EXPECT_NEAR(braking.rate(0.4, 1.0, 0.9), -braking.beside(0.9), 1e-12);
}

TEST(Braking, RefusesValuesOutOfRange) {
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    EXPECT_THROW(Braking(bad, 1.0), std::invalid_argument);
    EXPECT_THROW(Braking(1.0, bad), std::invalid_argument);
  }
  EXPECT_THROW(Braking(std::numeric_limits<double>::infinity()), std::invalid_argument);
}

}  // namespace
}  // namespace mocha
