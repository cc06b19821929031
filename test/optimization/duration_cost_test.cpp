#include "optimization/duration_cost.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

TEST(DurationCost, OfTheTotalIsProportional) {  // paper (34)
  const DurationCost cost = DurationCost::total(2.0);
  EXPECT_DOUBLE_EQ(cost.value(7.0), 14.0);
  EXPECT_DOUBLE_EQ(cost.slope(7.0), 2.0);
}

TEST(DurationCost, WithHorizonIsLeastAtIt) {  // paper (40)
  const DurationCost cost = DurationCost::with_horizon(2.0, 5.0);
  EXPECT_DOUBLE_EQ(cost.value(5.0), 0.0);
  EXPECT_DOUBLE_EQ(cost.slope(5.0), 0.0);
  EXPECT_DOUBLE_EQ(cost.value(8.0), 54.0);
  EXPECT_DOUBLE_EQ(cost.value(2.0), 54.0);
}

TEST(DurationCost, SlopeMatchesDifferences) {  // paper (41)
  constexpr double kStep = 1e-6;
  for (const DurationCost& cost :
       {DurationCost::total(0.3), DurationCost::with_horizon(0.7, 5.0)}) {
    for (const double total_s : {0.1, 3.0, 4.999, 5.2, 11.0}) {
      const double slope =
          (cost.value(total_s + kStep) - cost.value(total_s - kStep)) / (2.0 * kStep);
      EXPECT_NEAR(cost.slope(total_s), slope, 1e-6 * (1.0 + std::abs(slope)));
    }
  }
}

}  // namespace
}  // namespace mocha
