#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include "base/waveshare_base.h"
#include "control/closed_loop.h"
#include "ros_bridge/inputs/whole_exchanges.h"
#include "simulation/base_emulator.h"
#include "simulation/vehicle.h"

namespace mocha {
namespace {

using closed_loop::straight;

constexpr double kStep_s = 0.01;
constexpr double kStanding = 0.01;  // [m/s]

/// The tracker, the driver, its serial line, an emulated base and its vehicle, in a time of their
/// own.
class LowSpeedTest : public testing::TestWithParam<WheelDrive::Options> {
 protected:
  LowSpeedTest() { start(); }

  /// Switches all of it on, and lets it stand until the driver knows the bias of the gyroscope.
  void start() {
    WaveshareBase::Options options = WaveshareBase::Options::from(
        ParameterTable::from_schema("config/base_driver.yaml"), model_);
    options.device = "/tmp/mocha_low_speed_" + std::to_string(::getpid());
    options.feedback_delay_s = 0.0;  // the emulator's line has none
    line_.reset();
    driver_ = std::make_unique<WaveshareBase>(options);
    line_ = std::make_unique<Line>(options.device);
    const auto [breakaway_pwm, friction_pwm] = GetParam();
    const WheelDrive::Options uneven{1.1 * breakaway_pwm, 1.1 * friction_pwm};
    base_ = std::make_unique<BaseEmulator>(now_s_, BaseEmulator::Options{true, GetParam(), uneven});
    vehicle_ = std::make_unique<Vehicle>(model_, Pose{});
    tracker_ = TrajectoryTracker(TrackerParameters(), model_);
    feedback_.reset();
    reversals_ = way_ = 0;
    run(now_s_ + 2.0);
  }

  void run(double end_s) {
    for (int i = 0; now_s_ < end_s - 1e-9; now_s_ += kStep_s, ++i) {
      for (const BaseFeedback& news : driver_->poll(now_s_)) feedback_ = news;
      if (i % 2 == 0) command();
      base_->receive(now_s_, line_->read());
      const UnicycleState heading = from_wheel_speeds(base_->wheels(now_s_), model_.limits.track_m);
      vehicle_->command(now_s_, {heading.speed, heading.yaw_rate});
      const Arc arc = vehicle_->step(now_s_, kStep_s);
      const Twist twist = vehicle_->twist();
      const WheelSpeeds rolled = wheel_speeds({arc.length_m, arc.turn_rad}, model_.limits.track_m);
      const WheelSpeeds speeds = wheel_speeds({twist.speed, twist.yaw_rate}, model_.limits.track_m);
      base_->roll(rolled.left, rolled.right, speeds);
      base_->feel(vehicle_->acceleration(), twist.yaw_rate);
      line_->write(base_->send(now_s_ + kStep_s));
      note(speeds);
    }
  }

  void command() {
    std::optional<RobotState> state;
    if (feedback_) state = RobotState{feedback_->stamp_s, feedback_->pose, feedback_->twist};
    driver_->drive(tracker_.step(now_s_, state));
  }

  void note(const WheelSpeeds& speeds) {
    if (tracker_.motion().empty()) return;
    worst_m_ = std::max(worst_m_, error().position_m());
    const int way = std::abs(speeds.right) < kStanding ? 0 : speeds.right > 0.0 ? 1 : -1;
    if (way * way_ < 0) ++reversals_;
    if (way != 0) way_ = way;
    if (way != 0 || std::abs(speeds.left) >= kStanding) moved_s_ = now_s_;
  }

  /// What is really off the motion.
  TrackingError error() const {
    return tracking_error(vehicle_->pose(), tracker_.motion().at(now_s_).pose);
  }

  /// Drives from standing until 10 s after its end; by then it has stood for most of that.
  void drive(const Phase& phase) {
    const Motion motion(now_s_ + 0.3, {phase});
    tracker_.offer({1, 1}, motion, 1e9);
    run(motion.end_time() + 10.0);
    EXPECT_EQ(tracker_.mode(), TrackerMode::kHolding) << tracker_.stop_reason();
    EXPECT_LT(moved_s_, motion.end_time() + 3.0) << "it hunts";
    EXPECT_LT(error().position_m(), model_.margins.tracking_still_m);
    EXPECT_LT(worst_m_, model_.margins.tracking_still_m);
  }

  RobotModel model_ = load_robot_model("config", "waveshare_rover");
  TrajectoryTracker tracker_{TrackerParameters(), model_};
  std::unique_ptr<WaveshareBase> driver_;
  std::unique_ptr<Line> line_;
  std::unique_ptr<BaseEmulator> base_;
  std::unique_ptr<Vehicle> vehicle_;
  std::optional<BaseFeedback> feedback_;
  double now_s_ = 100.0;
  double moved_s_ = 0.0;
  double worst_m_ = 0.0;
  int way_ = 0;  // of the right wheel
  int reversals_ = 0;
};

TEST_P(LowSpeedTest, CreepsToAGoal) {
  drive(straight(vehicle_->pose(), 1, 0.5, 10.0));  // 0.09 m/s at its fastest
  EXPECT_LT(std::abs(error().heading_rad), 0.1);
  EXPECT_LE(reversals_, 3);
}

TEST_P(LowSpeedTest, BacksToAGoal) {
  drive(straight(vehicle_->pose(), -1, 1.0, 4.0));
  EXPECT_LT(std::abs(error().heading_rad), 0.1);
  EXPECT_LE(reversals_, 3);
}

TEST_P(LowSpeedTest, TurnsInPlace) {
  drive(TurnPhase{vehicle_->pose(), 1.5, 2.0});  // wheels of at most 0.13 m/s
  EXPECT_LT(std::abs(error().heading_rad), 0.1);
  EXPECT_LE(reversals_, 3);
}

TEST_P(LowSpeedTest, SettlesItsHeadingWithoutHunting) {
  for (const double heading_rad : {0.12, -0.06}) {
    start();
    drive(StandPhase{{vehicle_->pose().position, heading_rad}, 1.0});
    EXPECT_LT(std::abs(error().heading_rad), 0.1) << heading_rad;
    EXPECT_LE(reversals_, 3) << heading_rad;
  }
}

INSTANTIATE_TEST_SUITE_P(Friction, LowSpeedTest,
                         testing::Values(WheelDrive::Options{45.0, 35.0},
                                         WheelDrive::Options{35.0, 35.0},
                                         WheelDrive::Options{60.0, 35.0},
                                         WheelDrive::Options{60.0, 45.0},
                                         WheelDrive::Options{60.0, 50.0}));

/// Wheels that turn far more easily than the driver was told leap as they set off.
class WrongFrictionTest : public LowSpeedTest {};

TEST_P(WrongFrictionTest, DoesNotHuntWhereItStands) {
  drive(StandPhase{{vehicle_->pose().position, 0.12}, 1.0});
  EXPECT_LE(reversals_, 3);
}

INSTANTIATE_TEST_SUITE_P(Friction, WrongFrictionTest,
                         testing::Values(WheelDrive::Options{25.0, 20.0},
                                         WheelDrive::Options{0.0, 0.0}));

}  // namespace
}  // namespace mocha
