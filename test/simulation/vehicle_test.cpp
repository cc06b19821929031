#include "simulation/vehicle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "simulation/odometry.h"
#include "simulation/pose_history.h"

namespace mocha {
namespace {

constexpr double kStep_s = 0.02;

RobotModel model() {
  RobotModel model{};
  model.limits.max_wheel_speed = 1.4;
  model.max_wheel_acceleration = 2.0;
  model.limits.track_m = 0.4;
  model.actuator_lag_s = 0.0;
  model.cmd_timeout_s = 0.3;
  return model;
}

/// Repeats the command for a time; returns the time afterwards.
double drive(Vehicle& vehicle, const Twist& twist, double from_s, double duration_s) {
  const int steps = static_cast<int>(std::round(duration_s / kStep_s));
  for (int i = 0; i < steps; ++i) {
    vehicle.command(from_s + i * kStep_s, twist);
    vehicle.step(from_s + i * kStep_s, kStep_s);
  }
  return from_s + steps * kStep_s;
}

TEST(Vehicle, AcceleratesNoFasterThanItsWheels) {
  Vehicle vehicle(model(), {});
  double speed = 0.0;
  for (int i = 0; i < 100; ++i) {
    vehicle.command(i * kStep_s, {1.0, 0.0});
    vehicle.step(i * kStep_s, kStep_s);
    EXPECT_LE(vehicle.twist().speed - speed, 2.0 * kStep_s + 1e-12);
    if (vehicle.twist().speed < 1.0) {
      EXPECT_NEAR(vehicle.acceleration(), 2.0, 1e-9);
    }
    speed = vehicle.twist().speed;
  }
  EXPECT_NEAR(speed, 1.0, 1e-12);
  // 0.5 s up the ramp, then 1.5 s at 1 m/s.
  EXPECT_NEAR(vehicle.pose().position.x(), 0.25 + 1.5, 1e-9);
}

TEST(Vehicle, DoesNotDriveBackwardWhereItsModelCannot) {
  RobotModel forward = model();
  forward.limits.can_reverse = false;
  Vehicle vehicle(forward, {});
  drive(vehicle, {1.0, 0.0}, 0.0, 1.0);
  const double reached_m = vehicle.pose().position.x();
  drive(vehicle, {-1.0, 0.0}, 1.0, 3.0);
  EXPECT_EQ(vehicle.twist().speed, 0.0);
  EXPECT_GT(vehicle.pose().position.x(), reached_m);
  drive(vehicle, {-1.0, 1.0}, 4.0, 1.0);
  EXPECT_NEAR(vehicle.twist().yaw_rate, 1.0, 1e-9) << "it still turns in place";
}

TEST(Vehicle, ScalesBothWheelsSoThatTheCurvatureStays) {
  Vehicle vehicle(model(), {});
  drive(vehicle, {2.0, 4.0}, 0.0, 3.0);  // wants 1.2 and 2.8 m/s at the wheels
  EXPECT_NEAR(vehicle.twist().speed, 1.0, 1e-9);
  EXPECT_NEAR(vehicle.twist().yaw_rate, 2.0, 1e-9);
  drive(vehicle, {-5.0, 0.0}, 3.0, 3.0);
  EXPECT_NEAR(vehicle.twist().speed, -1.4, 1e-9);
  drive(vehicle, {0.0, -100.0}, 6.0, 3.0);
  EXPECT_NEAR(vehicle.twist().yaw_rate, -7.0, 1e-9);
}

TEST(Vehicle, FollowsWithAFirstOrderLag) {
  RobotModel slow = model();
  slow.actuator_lag_s = 0.2;
  slow.max_wheel_acceleration = 100.0;
  Vehicle vehicle(slow, {});
  drive(vehicle, {1.0, 0.0}, 0.0, 0.2);
  EXPECT_NEAR(vehicle.twist().speed, 1.0 - std::exp(-1.0), 1e-9);
  drive(vehicle, {1.0, 0.0}, 0.2, 0.2);
  EXPECT_NEAR(vehicle.twist().speed, 1.0 - std::exp(-2.0), 1e-9);
}

TEST(Vehicle, DrivesExactCircles) {
  Vehicle vehicle(model(), {});
  const double from = drive(vehicle, {0.5, 0.5}, 0.0, 2.0);
  const Pose start = vehicle.pose();
  // A quarter of a circle of radius 1 m, in steps that are not short against it.
  constexpr int kSteps = 8;
  const double dt = M_PI / 2.0 / 0.5 / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    vehicle.command(from + i * dt, {0.5, 0.5});
    vehicle.step(from + i * dt, dt);
  }
  const Vector2 moved = vehicle.pose().position - start.position;
  EXPECT_NEAR(moved.norm(), std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(wrap_angle(std::atan2(moved.y(), moved.x()) - start.yaw_rad), M_PI / 4.0, 1e-9);
  EXPECT_NEAR(wrap_angle(vehicle.pose().yaw_rad - start.yaw_rad), M_PI / 2.0, 1e-9);
}

TEST(Vehicle, StopsWhenTheCommandIsStale) {
  Vehicle vehicle(model(), {});
  EXPECT_EQ(vehicle.step(0.0, kStep_s).length_m, 0.0);  // never had one
  const double last = drive(vehicle, {1.0, 0.5}, 0.0, 2.0) - kStep_s;
  double now = last + kStep_s;
  for (; now <= last + 0.3 + 1e-9; now += kStep_s) vehicle.step(now, kStep_s);
  EXPECT_NEAR(vehicle.twist().speed, 1.0, 1e-9);  // 0.3 s old is not too old
  for (int i = 0; i < 30; ++i, now += kStep_s) vehicle.step(now, kStep_s);
  EXPECT_EQ(vehicle.twist().speed, 0.0);  // 1 m/s at 2 m/s^2, and 0.1 s to spare
  EXPECT_EQ(vehicle.twist().yaw_rate, 0.0);
}

TEST(Vehicle, RefusesCommandsThatAreNotFiniteAndSurvivesAbsurdOnes) {
  Vehicle vehicle(model(), {});
  EXPECT_THROW(vehicle.command(0.0, {NAN, 0.0}), std::invalid_argument);
  EXPECT_THROW(vehicle.command(0.0, {0.0, std::numeric_limits<double>::infinity()}),
               std::invalid_argument);
  EXPECT_EQ(vehicle.step(0.0, kStep_s).length_m, 0.0);
  drive(vehicle, {1e308, -1e308}, 0.0, 1.0);
  drive(vehicle, {1e308, 1e308}, 1.0, 1.0);
  EXPECT_TRUE(vehicle.pose().position.allFinite());
  EXPECT_LE(std::abs(vehicle.twist().speed), 1.4);
}

TEST(Odometry, WithoutNoiseItIsTheTruth) {
  Vehicle vehicle(model(), {});
  Odometry odometry(0.0, 0.0, 1);
  for (int i = 0; i < 300; ++i) {
    vehicle.command(i * kStep_s, {0.8, std::sin(0.1 * i)});
    odometry.add(vehicle.step(i * kStep_s, kStep_s), vehicle.twist());
  }
  EXPECT_NEAR((odometry.pose().position - vehicle.pose().position).norm(), 0.0, 1e-9);
  EXPECT_NEAR(odometry.pose().yaw_rad, vehicle.pose().yaw_rad, 1e-9);
}

TEST(Odometry, DriftsAsARandomWalkWhateverTheStep) {
  constexpr int kRuns = 2000;
  for (int steps : {10, 400}) {
    double along_squared = 0.0;
    double turn_squared = 0.0;
    double along_sum = 0.0;
    for (int run = 0; run < kRuns; ++run) {
      Odometry straight(0.02, 0.01, 17 + run);
      Odometry turning(0.02, 0.01, 17 + run);
      for (int i = 0; i < steps; ++i) straight.add({4.0 / steps, 0.0}, {});
      for (int i = 0; i < steps; ++i) turning.add({0.0, -2.25 / steps}, {});
      along_sum += straight.pose().position.x() - 4.0;
      along_squared += std::pow(straight.pose().position.x() - 4.0, 2);
      turn_squared += std::pow(turning.pose().yaw_rad + 2.25, 2);
    }
    EXPECT_NEAR(std::sqrt(along_squared / kRuns), 0.02 * std::sqrt(4.0), 0.002) << steps;
    EXPECT_NEAR(std::sqrt(turn_squared / kRuns), 0.01 * std::sqrt(2.25), 0.001) << steps;
    EXPECT_NEAR(along_sum / kRuns, 0.0, 0.004) << steps;
  }
}

TEST(Odometry, StandsStillWithTheRobotAndRepeatsWithItsSeed) {
  Odometry first(0.02, 0.01, 5);
  Odometry second(0.02, 0.01, 5);
  Odometry other(0.02, 0.01, 6);
  for (int i = 0; i < 100; ++i) first.add({0.0, 0.0}, {});
  EXPECT_EQ(first.pose().position, Vector2(0.0, 0.0));
  for (int i = 0; i < 100; ++i) second.add({0.0, 0.0}, {});
  for (Odometry* odometry : {&first, &second, &other}) odometry->add({1.0, 0.3}, {});
  EXPECT_EQ(first.pose().position, second.pose().position);
  EXPECT_NE(first.pose().position, other.pose().position);
}

TEST(PoseHistory, InterpolatesTheShortWayRound) {
  PoseHistory past(10.0);
  past.add(1.0, {{0.0, 0.0}, 3.0});
  past.add(2.0, {{2.0, 4.0}, -3.0});
  const Pose middle = past.at(1.5);
  EXPECT_NEAR((middle.position - Vector2(1.0, 2.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(std::abs(middle.yaw_rad), M_PI, 1e-9);
  EXPECT_EQ(past.at(0.0).yaw_rad, 3.0);
  EXPECT_EQ(past.at(9.0).yaw_rad, -3.0);
}

TEST(PoseHistory, KeepsItsSpan) {
  PoseHistory past(0.5);
  for (int i = 0; i <= 100; ++i) past.add(0.1 * i, {{0.1 * i, 0.0}, 0.0});
  EXPECT_NEAR(past.at(9.5).position.x(), 9.5, 1e-9);
  EXPECT_GT(past.at(2.0).position.x(), 9.0);  // forgotten
}

}  // namespace
}  // namespace mocha
