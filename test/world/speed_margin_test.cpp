#include "world/speed_margin.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

TEST(SpeedMargin, GrowsWithTheSquareOfTheSpeed) {
  const SpeedMargin margin(0.03, 0.07);
  EXPECT_DOUBLE_EQ(margin.at(0.0), 0.03);
  EXPECT_DOUBLE_EQ(margin.at(0.5), 0.0475);
  EXPECT_DOUBLE_EQ(margin.at(-0.5), 0.0475);
  EXPECT_DOUBLE_EQ(margin.at(1.0), 0.1);
}

TEST(SpeedMargin, TheFastestSpeedFillsTheRoom) {
  const SpeedMargin margin(0.03, 0.07);
  for (const double speed : {0.0, 0.2, 1.3})
    EXPECT_NEAR(margin.fastest(margin.at(speed)), speed, 1e-12);
  EXPECT_LT(margin.fastest(0.029), 0.0);
}

TEST(SpeedMargin, OfANumberIsTheSameAtEverySpeed) {
  const SpeedMargin margin = 0.1;
  EXPECT_EQ(margin.at(5.0), 0.1);
  EXPECT_EQ(margin.fastest(0.1), std::numeric_limits<double>::infinity());
  EXPECT_LT(margin.fastest(0.09), 0.0);
}

}  // namespace
}  // namespace mocha
