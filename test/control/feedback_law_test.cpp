#include "control/feedback_law.h"

#include <gtest/gtest.h>

#include "control/closed_loop.h"
#include "control/command_limiter.h"

namespace mocha {
namespace {

const FeedbackGains kGains;

TEST(FeedbackLaw, WithoutErrorItIsTheFeedforward) {
  const Pose pose{{1.0, 2.0}, 0.7};
  for (const UnicycleState feedforward :
       {UnicycleState{1.0, 0.5}, UnicycleState{-0.7, 0.2}, UnicycleState{0.0, 1.0}}) {
    const UnicycleState command = feedback(pose, pose, feedforward, kGains);
    EXPECT_NEAR(command.speed, feedforward.speed, 1e-12);
    EXPECT_NEAR(command.yaw_rate, feedforward.yaw_rate, 1e-12);
  }
}

TEST(FeedbackLaw, TurnsTowardsThePathForwardAndBackward) {
  const Pose reference;
  const Pose left{{0.0, 0.1}, 0.0};
  EXPECT_LT(feedback(left, reference, {1.0, 0.0}, kGains).yaw_rate, 0.0);
  EXPECT_GT(feedback(left, reference, {-1.0, 0.0}, kGains).yaw_rate, 0.0);
}

TEST(FeedbackLaw, NeverReverses) {
  const Pose ahead{{1.0, 0.0}, 0.0};
  EXPECT_EQ(feedback(ahead, {}, {0.5, 0.0}, kGains).speed, 0.0);
  const Pose behind{{-1.0, 0.0}, 0.0};
  EXPECT_EQ(feedback(behind, {}, {-0.5, 0.0}, kGains).speed, 0.0);
  EXPECT_EQ(feedback(behind, {}, {0.0, 1.0}, kGains).speed, 0.0)
      << "a turn in place stays in place";
}

TEST(FeedbackLaw, LyapunovFunctionFalls) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> metres(-0.3, 0.3), radians(-1.0, 1.0), speeds(0.8, 1.5);
  const auto energy = [](const Pose& pose, const Pose& reference) {
    const TrackingError error = tracking_error(pose, reference);
    return kGains.across * kGains.across * error.position_m() * error.position_m() +
           error.heading_rad * error.heading_rad;
  };
  for (int i = 0; i < 200; ++i) {
    const double direction = i % 2 == 0 ? 1.0 : -1.0;
    const UnicycleState forward{direction * speeds(random), radians(random)};
    const Pose pose{{metres(random), metres(random)}, radians(random)};
    const UnicycleState command = feedback(pose, {}, forward, kGains);
    constexpr double kStep_s = 1e-5;
    const double change =
        energy(predict({0.0, pose, command}, kStep_s), predict({0.0, {}, forward}, kStep_s)) -
        energy(pose, {});
    if (command.speed != 0.0) {
      EXPECT_LT(change, 0.0);
    }
  }
}

TEST(TrackingError, IsInTheFrameOfTheReference) {
  const Pose reference{{1.0, 1.0}, M_PI / 2.0};
  const TrackingError error = tracking_error({{0.8, 1.1}, M_PI / 2.0 + 0.2}, reference);
  EXPECT_NEAR(error.along_m, 0.1, 1e-12);
  EXPECT_NEAR(error.across_m, 0.2, 1e-12);
  EXPECT_NEAR(error.heading_rad, 0.2, 1e-12);
}

TEST(CommandLimiter, KeepsWheelsWithinTheirLimits) {
  const RobotModel model = closed_loop::rover();
  CommandLimiter limiter(model);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> speed(-3.0, 3.0), yaw_rate(-12.0, 12.0);
  WheelSpeeds last{0.0, 0.0};
  for (int i = 0; i < 500; ++i) {
    const UnicycleState command = limiter.limit({speed(random), yaw_rate(random)}, 0.02);
    const WheelSpeeds wheels = wheel_speeds(command, model.limits.track_m);
    for (const auto& [now, before] :
         {std::pair(wheels.left, last.left), std::pair(wheels.right, last.right)}) {
      EXPECT_LE(std::abs(now), model.limits.max_wheel_speed + 1e-9);
      EXPECT_LE(std::abs(now - before), model.max_wheel_acceleration * 0.02 + 1e-9);
    }
    last = wheels;
  }
}

TEST(CommandLimiter, PrefersTheYawRate) {
  const RobotModel model = closed_loop::rover();
  CommandLimiter limiter(model);
  UnicycleState command{};
  for (int i = 0; i < 200; ++i) command = limiter.limit({1.4, 2.0}, 0.02);
  EXPECT_NEAR(command.yaw_rate, 2.0, 1e-9);
  EXPECT_NEAR(command.speed, model.limits.max_wheel_speed - model.limits.track_m, 1e-9);
}

TEST(CommandLimiter, NeverDrivesABaseBackwardThatCannot) {
  RobotModel model = closed_loop::rover();
  model.limits.can_reverse = false;
  CommandLimiter limiter(model);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> speed(-3.0, 3.0), yaw_rate(-12.0, 12.0);
  for (int i = 0; i < 500; ++i)
    EXPECT_GE(limiter.limit({speed(random), yaw_rate(random)}, 0.02).speed, -1e-12);
  UnicycleState command{};
  for (int i = 0; i < 200; ++i) command = limiter.limit({-1.0, 2.0}, 0.02);
  EXPECT_NEAR(command.speed, 0.0, 1e-12);
  EXPECT_NEAR(command.yaw_rate, 2.0, 1e-9) << "it still turns in place";
}

TEST(CommandLimiter, RampDownKeepsTheCurvature) {
  CommandLimiter limiter(closed_loop::rover());
  for (int i = 0; i < 100; ++i) limiter.limit({0.8, 0.4}, 0.02);
  int steps = 0;
  for (; limiter.last().speed > 0.0; ++steps) {
    const UnicycleState command = limiter.ramp_down(0.02);
    EXPECT_NEAR(command.yaw_rate, 0.5 * command.speed, 1e-9);
    ASSERT_LT(steps, 100);
  }
  EXPECT_NEAR(0.02 * steps, 1.0, 0.03) << "0.8 m/s at 0.8 m/s^2";
}

TEST(Predict, FollowsTheArc) {
  const RobotState state{1.0, {{0.0, 0.0}, 0.0}, {1.0, 1.0}};
  const Pose pose = predict(state, 1.0 + M_PI / 2.0);
  EXPECT_NEAR(pose.position.x(), 1.0, 1e-9);
  EXPECT_NEAR(pose.position.y(), 1.0, 1e-9);
  EXPECT_NEAR(pose.yaw_rad, M_PI / 2.0, 1e-9);
}

}  // namespace
}  // namespace mocha
