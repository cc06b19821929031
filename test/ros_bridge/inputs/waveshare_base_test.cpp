#include "base/waveshare_base.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>

#include "simulation/base_emulator.h"
#include "simulation/pseudo_terminal.h"

namespace mocha {
namespace {

constexpr double kStep_s = 0.01;

/// Waits for what the kernel carries; the time-out only bounds a failure.
template <typename Condition>
void wait_until(Condition condition) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) throw std::runtime_error("no bytes come");
    std::this_thread::yield();
  }
}

/// A serial line of software that hands over only whole exchanges.
class Line {
 public:
  explicit Line(const std::string& link)
      : terminal_(link), computer_(::open(terminal_.path().c_str(), O_RDWR | O_NOCTTY)) {}
  ~Line() { ::close(computer_); }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  /// All that the driver has sent: what comes before a mark that is sent after it.
  std::string read() {
    constexpr char kMark = '\x01';
    if (::write(computer_, &kMark, 1) != 1) throw std::runtime_error("the line takes no mark");
    std::string text;
    wait_until([&] {
      text += terminal_.read();
      return !text.empty() && text.back() == kMark;
    });
    text.pop_back();
    return text;
  }

  /// Returns once the driver can read it.
  void write(const std::string& text) {
    terminal_.write(text);
    wait_until([&] {
      int arrived = 0;
      return ::ioctl(computer_, FIONREAD, &arrived) == 0 &&
             arrived >= static_cast<int>(text.size());
    });
  }

 private:
  PseudoTerminal terminal_;
  int computer_;
};

/// A driver and an emulated base on a pseudo-terminal, in a time of their own.
class WaveshareBaseTest : public testing::Test {
 protected:
  WaveshareBaseTest() : link_("/tmp/mocha_waveshare_base_" + std::to_string(::getpid())) {
    options_.device = link_;
    options_.feedback_delay_s = 0.0;  // the emulator's line has none
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
      wheels_ = base_.wheels(now_s_);
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
  BaseEmulator base_{0.0, false};
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
  for (; base_.wheels(now_s_).left != 0.0; now_s_ += kStep_s) ASSERT_LT(now_s_, 110.0);
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
  EXPECT_EQ(base_.wheels(now_s_).left, 0.0);
}

}  // namespace
}  // namespace mocha
