#include "trajectory/unicycle.h"

#include <gtest/gtest.h>

#include "trajectory/piecewise_polynomial.h"

namespace mocha {
namespace {

UnicycleState at(const PlanarPath& path, int direction, double t) {
  return unicycle_state(direction, path.derivative(t, 1), path.derivative(t, 2),
                        path.derivative(t, 3), path.derivative(t, 4));
}

PlanarPath path_of(std::initializer_list<double> x, std::initializer_list<double> y) {
  PlanarPath::Piece piece;
  std::copy(x.begin(), x.end(), piece.row(0).begin());
  std::copy(y.begin(), y.end(), piece.row(1).begin());
  return PlanarPath({piece}, {1.0});
}

TEST(Unicycle, CircleHasConstantYawRate) {
  const double radius = 2.0;
  const double rate = 0.7;
  const Eigen::Vector2d velocity(0.0, radius * rate);
  const Eigen::Vector2d acceleration(-radius * rate * rate, 0.0);
  const Eigen::Vector2d none = Eigen::Vector2d::Zero();
  EXPECT_NEAR(unicycle_state(1, velocity, acceleration, none, none).speed, 1.4, 1e-12);
  EXPECT_NEAR(unicycle_state(1, velocity, acceleration, none, none).yaw_rate, rate, 1e-12);
  // Backward on the same curve: the body turns as fast, the speed is negative.
  EXPECT_NEAR(unicycle_state(-1, velocity, acceleration, none, none).speed, -1.4, 1e-12);
  EXPECT_NEAR(unicycle_state(-1, velocity, acceleration, none, none).yaw_rate, rate, 1e-12);
}

TEST(Unicycle, StandstillIsTheLimitOfNearbyTimes) {
  const PlanarPath by_acceleration = path_of({0, 0, 1, 0.3, 0, 0}, {0, 0, 0.5, -0.8, 0.2, 0});
  const PlanarPath by_jerk = path_of({0, 0, 0, 1, 0.5, 0}, {0, 0, 0, -0.4, 1.3, 0.1});
  for (const PlanarPath& path : {by_acceleration, by_jerk}) {
    EXPECT_GT(std::abs(at(path, 1, 0.0).yaw_rate), 0.1);
    EXPECT_NEAR(at(path, 1, 0.0).yaw_rate, at(path, 1, 0.02).yaw_rate, 0.1);
    EXPECT_NEAR(at(path, -1, 0.0).yaw_rate, at(path, -1, 0.02).yaw_rate, 0.1);
    EXPECT_EQ(at(path, 1, 0.0).speed, 0.0);
  }
}

TEST(Unicycle, StandingStillTurnsAtNoRate) {
  const Eigen::Vector2d none = Eigen::Vector2d::Zero();
  EXPECT_EQ(unicycle_state(1, none, none, none, none).yaw_rate, 0.0);
}

TEST(Unicycle, WheelSpeedsGoThereAndBack) {
  const WheelSpeeds wheels = wheel_speeds({1.0, 0.5}, 0.4);
  EXPECT_NEAR(wheels.left, 0.9, 1e-12);
  EXPECT_NEAR(wheels.right, 1.1, 1e-12);
  const UnicycleState back = from_wheel_speeds(wheels, 0.4);
  EXPECT_NEAR(back.speed, 1.0, 1e-12);
  EXPECT_NEAR(back.yaw_rate, 0.5, 1e-12);
}

}  // namespace
}  // namespace mocha
