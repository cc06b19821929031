#include "trajectory/time_scaling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "trajectory/extrema.h"
#include "trajectory/minco_problem.h"

namespace mocha {
namespace {

template <int D, int S>
PiecewisePolynomial<D, S> from_rest_to_rest(int pieces, int seed) {
  test::Problem<D, S> problem(pieces, seed);
  problem.start.template rightCols<S - 1>().setZero();
  problem.end.template rightCols<S - 1>().setZero();
  return problem.solved().curve();
}

template <typename Case>
class TimeScalingTest : public ::testing::Test {};
TYPED_TEST_SUITE(TimeScalingTest, test::AllCases);

TYPED_TEST(TimeScalingTest, BringsACurveJustWithinItsLimits) {
  for (int seed = 0; seed < 10; ++seed) {
    const auto curve = from_rest_to_rest<TypeParam::D, TypeParam::S>(1 + seed % 5, seed);
    const double speed = max_speed(curve).value;
    const double acceleration = max_acceleration(curve).value;
    // The speed decides, then the acceleration.
    for (const StretchLimits& limits : {StretchLimits{0.3 * speed, 0.2 * acceleration, 10.0},
                                        StretchLimits{0.4 * speed, 0.1 * acceleration, 10.0}}) {
      const auto factor = smallest_stretch(curve, limits);
      ASSERT_TRUE(factor);
      EXPECT_GT(*factor, 1.0);
      const auto slow = curve.stretched(*factor);
      EXPECT_LE(max_speed(slow).value, limits.speed * (1.0 + 2e-9));
      EXPECT_LE(max_acceleration(slow).value, limits.acceleration * (1.0 + 2e-9));
      const auto faster = curve.stretched(*factor * (1.0 - 1e-8));
      EXPECT_TRUE(max_speed(faster).value > limits.speed ||
                  max_acceleration(faster).value > limits.acceleration);
    }
  }
}

class TimeScaling : public ::testing::Test {
 protected:
  const PlanarPath curve = from_rest_to_rest<2, 3>(4, 2);
  const double speed = max_speed(curve).value;
  const double acceleration = max_acceleration(curve).value;
};

TEST_F(TimeScaling, LeavesACurveWithinItsLimitsAsItIs) {
  EXPECT_EQ(smallest_stretch(curve, {2.0 * speed, 2.0 * acceleration, 1.0}), 1.0);
  EXPECT_EQ(smallest_stretch(curve, {speed, acceleration, 1.0}), 1.0);
  PlanarPath::Piece cruise = PlanarPath::Piece::Zero();
  cruise(0, 1) = 3.0;  // at 1.5 m/s all the time: a limit reached is a limit kept
  EXPECT_EQ(smallest_stretch(PlanarPath({cruise}, {2.0}), {1.5, 1.0, 10.0}), 1.0);
  EXPECT_EQ(smallest_stretch(PlanarPath({PlanarPath::Piece::Zero()}, {1.0}), {1e-3, 1e-3, 1.0}),
            1.0);
}

TEST_F(TimeScaling, GivesUpBeyondTheLargestFactor) {
  EXPECT_FALSE(smallest_stretch(curve, {speed / 3.0, acceleration, 2.9}));
  EXPECT_NEAR(smallest_stretch(curve, {speed / 3.0, acceleration, 3.1}).value(), 3.0, 1e-8);
  EXPECT_FALSE(smallest_stretch(curve, {speed, acceleration / 9.0, 2.9}));
  EXPECT_NEAR(smallest_stretch(curve, {speed, acceleration / 9.0, 3.1}).value(), 3.0, 1e-8);
}

TEST_F(TimeScaling, DoesNotTouchBoundaryVelocities) {
  const PlanarPath ends[] = {curve.slice(0.5, curve.duration()),
                             curve.slice(0.0, 0.9 * curve.duration())};
  for (const PlanarPath& part : ends) {
    EXPECT_FALSE(smallest_stretch(part, {0.5 * max_speed(part).value, 100.0 * acceleration, 10.0}));
    EXPECT_EQ(smallest_stretch(part, {speed, acceleration, 10.0}), 1.0);
  }
}

TEST_F(TimeScaling, RefusesBadArguments) {
  const double nan = std::nan("");
  for (const double bad : {0.0, -1.0, nan}) {
    EXPECT_THROW(smallest_stretch(curve, {bad, 1.0, 2.0}), std::invalid_argument);
    EXPECT_THROW(smallest_stretch(curve, {1.0, bad, 2.0}), std::invalid_argument);
    EXPECT_THROW(smallest_stretch(curve, {1.0, 1.0, bad}), std::invalid_argument);
  }
  EXPECT_THROW(smallest_stretch(PlanarPath(), {1.0, 1.0, 2.0}), std::invalid_argument);
}

}  // namespace
}  // namespace mocha
