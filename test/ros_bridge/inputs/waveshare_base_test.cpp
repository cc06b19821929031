#include "base/waveshare_base.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <memory>

#include "ros_bridge/inputs/whole_exchanges.h"
#include "simulation/base_emulator.h"

namespace mocha {
namespace {

constexpr double kStep_s = 0.01;

/// A driver and an emulated base on a pseudo-terminal, in a time of their own.
class WaveshareBaseTest : public testing::Test {
 protected:
  WaveshareBaseTest() : link_("/tmp/mocha_waveshare_base_" + std::to_string(::getpid())) {
    options_.device = link_;
    options_.feedback_delay_s = 0.0;  // the emulator's line has none
    options_.wheel_control.reset();   // so that the wheels are told speeds
    driver_ = std::make_unique<WaveshareBase>(options_);
    plug();
  }

  void plug() { line_ = std::make_unique<Line>(link_); }

  /// Drives so for a while; whatever the wheels are told, they do at once.
  void run(double duration_s, const UnicycleState& command) {
    for (const double end_s = now_s_ + duration_s; now_s_ < end_s - 1e-9; now_s_ += kStep_s) {
      const auto feedback = driver_->poll(now_s_);
      if (!feedback.empty()) newest_ = feedback.back();
      driver_->drive(command);
      if (line_) base_.receive(now_s_, line_->read());
      wheels_ = base_.order(now_s_).wheels;
      base_.roll(wheels_.left * kStep_s, wheels_.right * kStep_s, wheels_);
      const std::string text = base_.send(now_s_);
      if (line_) line_->write(text);
    }
  }

  std::string link_;
  WaveshareBase::Options options_ =
      WaveshareBase::Options::from(ParameterTable::from_schema("config/base_driver.yaml"),
                                   load_robot_model("config", "waveshare_rover"));
  std::unique_ptr<WaveshareBase> driver_;
  std::unique_ptr<Line> line_;
  BaseEmulator base_{0.0, {false, {}, {}}};
  double now_s_ = 100.0;
  WheelSpeeds wheels_ = {0.0, 0.0};
  BaseFeedback newest_;
};

TEST_F(WaveshareBaseTest, DrivesAndTellsHowFar) {
  run(0.2, {0.0, 0.0});
  EXPECT_TRUE(driver_->connected(now_s_)) << driver_->fault(now_s_);
  const double from_m = newest_.pose.position.x();
  run(1.0, {0.5, 0.0});
  run(0.1, {0.0, 0.0});
  EXPECT_NEAR(newest_.pose.position.x() - from_m, 0.5, 0.012);
  EXPECT_NEAR(newest_.pose.position.y(), 0.0, 0.02);
  EXPECT_EQ(driver_->fault(now_s_), "");
}

TEST_F(WaveshareBaseTest, WhatIsBeyondTheFirmwareIsDrivenSlowerOnTheSameCurve) {
  run(0.3, {4.0, 10.0});
  EXPECT_NEAR(wheels_.right, 2.0, 1e-4);
  const UnicycleState driven = from_wheel_speeds(wheels_, options_.odometry.track_m);
  EXPECT_NEAR(driven.yaw_rate / driven.speed, 10.0 / 4.0, 1e-3);
}

/// The firmware's own heartbeat is 3 s.
TEST_F(WaveshareBaseTest, ARestartedBaseLearnsItsHeartbeatWithinASecond) {
  run(0.5, {0.5, 0.0});
  base_.restart(now_s_);
  run(1.1, {0.5, 0.0});
  EXPECT_EQ(wheels_.left, 0.5);
  const double silent_from_s = now_s_;
  for (; base_.order(now_s_).wheels.left != 0.0; now_s_ += kStep_s) ASSERT_LT(now_s_, 110.0);
  EXPECT_LT(now_s_ - silent_from_s, 0.32);
}

TEST_F(WaveshareBaseTest, HoldsAnEmergencyStopThatTheFirmwareDoesNotHold) {
  run(0.5, {0.5, 0.0});
  driver_->set_emergency_stop(true);
  run(kStep_s, {0.5, 0.0});
  EXPECT_EQ(wheels_.left, 0.0);
  run(1.5, {0.5, 0.0});
  EXPECT_EQ(wheels_.left, 0.0);
  driver_->set_emergency_stop(false);
  run(0.1, {0.5, 0.0});
  EXPECT_EQ(wheels_.left, 0.5);
}

TEST_F(WaveshareBaseTest, AnEmergencyStopOutlivesAPulledLine) {
  run(0.5, {0.5, 0.0});
  line_.reset();
  run(0.5, {0.5, 0.0});
  EXPECT_FALSE(driver_->connected(now_s_));
  EXPECT_NE(driver_->fault(now_s_), "");
  driver_->set_emergency_stop(true);
  plug();
  run(1.0, {0.5, 0.0});
  EXPECT_TRUE(driver_->connected(now_s_));
  EXPECT_EQ(wheels_.left, 0.0);
}

TEST_F(WaveshareBaseTest, HalfALineOfAFormerDriverDoesNotSpoilTheFirstSetting) {
  base_.receive(now_s_, "{\"T\":1,\"L\":0.5,");
  run(0.05, {0.5, 0.0});
  now_s_ += 0.31;
  EXPECT_EQ(base_.order(now_s_).wheels.left, 0.0);
}

}  // namespace
}  // namespace mocha
