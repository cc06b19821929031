#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "control/closed_loop.h"

namespace mocha {
namespace {

using namespace closed_loop;

constexpr double kForever = 1e9;

struct Figures {
  std::vector<double> position, heading;

  void add(const std::vector<Sample>& samples) {
    for (const Sample& sample : samples) {
      position.push_back(sample.error.position_m());
      heading.push_back(std::abs(sample.error.heading_rad));
    }
  }
  static double quantile(std::vector<double> values, double q) {
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(q * (values.size() - 1))];
  }
  void print(const char* name) const {
    std::cout << name << ": position error median " << 1e3 * quantile(position, 0.5) << " mm, 99 % "
              << 1e3 * quantile(position, 0.99) << " mm, worst " << 1e3 * quantile(position, 1.0)
              << " mm; heading error median " << quantile(heading, 0.5) << " rad, worst "
              << quantile(heading, 1.0) << " rad\n";
  }
};

/// Forward or backward drives at the limits, the pose noisy.
Figures drive_winding(const RobotModel& model, int direction, int runs) {
  Figures figures;
  std::mt19937 random(7);
  for (int run = 0; run < runs; ++run) {
    const DrivePhase drive = winding(model.limits, direction, random);
    ClosedLoop loop(model, start_of(drive), run);
    const Motion motion(0.5, {drive});
    loop.tracker.offer({1, 1}, motion, kForever);
    const auto samples = loop.run(motion.end_time() + 2.0);
    figures.add(samples);
    EXPECT_EQ(loop.tracker.mode(), TrackerMode::kHolding)
        << "run " << run << ": " << loop.tracker.stop_reason();
    EXPECT_LT(worst_position_error(samples), 0.05) << "run " << run;
    EXPECT_LE(yaw_sign_changes(samples, motion.end_time() + 0.2), 0) << "run " << run;
  }
  return figures;
}

TEST(TrackingAccuracy, RoverForwardWithinFiveCentimetres) {
  const Figures figures = drive_winding(rover(), 1, 30);
  figures.print("rover forward");
  EXPECT_LT(Figures::quantile(figures.position, 0.5), 0.015);
}

TEST(TrackingAccuracy, RoverBackwardWithinFiveCentimetres) {
  drive_winding(rover(), -1, 30).print("rover backward");
}

TEST(TrackingAccuracy, JackalForwardWithinFiveCentimetres) {
  const Figures figures = drive_winding(jackal(), 1, 30);
  figures.print("jackal forward");
  EXPECT_LT(Figures::quantile(figures.position, 0.5), 0.02);
}

TEST(TrackingAccuracy, JackalBackwardWithinFiveCentimetres) {
  drive_winding(jackal(), -1, 30).print("jackal backward");
}

/// Wheels that are slower to follow, smaller and farther apart than the model says, and odometry
/// every 60 ms.
TEST(TrackingAccuracy, WrongModelStaysWithinTheErrorBound) {
  Figures figures;
  for (const RobotModel& model : {rover(), jackal()}) {
    std::mt19937 random(9);
    for (int run = 0; run < 15; ++run) {
      const DrivePhase drive = winding(model.limits, 1, random);
      RobotModel real = model;
      real.actuator_lag_s *= 1.5;
      real.limits.track_m *= 1.05;
      ClosedLoop loop(model, start_of(drive), run);
      loop.robot = SimulatedRobot(real, start_of(drive), 0.97);
      int steps = 0;
      loop.blind = [&steps](double) { return ++steps % 3 != 1; };
      const Motion motion(0.5, {drive});
      loop.tracker.offer({1, 1}, motion, kForever);
      const auto samples = loop.run(motion.end_time() + 1.0);
      figures.add(samples);
      EXPECT_EQ(loop.tracker.mode(), TrackerMode::kHolding)
          << "run " << run << ": " << loop.tracker.stop_reason();
      EXPECT_LT(worst_position_error(samples), model.margins.tracking_m);
    }
  }
  figures.print("wrong model");
}

TEST(TrackingAccuracy, OffsetAtTheStartConverges) {
  RobotModel model = rover();
  model.margins.tracking_m = 0.1;  // room for the noise on top of the offset
  model.margins.tracking_still_m = 0.1;
  for (const int direction : {1, -1}) {
    const DrivePhase drive = straight({{0.0, 0.0}, 0.4}, direction, 4.0, 9.0);
    for (const Vector2& offset :
         {Vector2(0.05, 0.0), Vector2(-0.05, 0.0), Vector2(0.0, 0.05), Vector2(0.03, -0.04)}) {
      Pose start = start_of(drive);
      start.position += offset;
      ClosedLoop loop(model, start, 1);
      loop.tracker.offer({1, 1}, Motion(0.0, {drive}), kForever);
      const auto samples = loop.run(11.0);
      EXPECT_LT(worst_position_error(samples), 0.065);
      EXPECT_LT(samples.back().error.position_m(), 0.015);
      EXPECT_LT(std::abs(samples.back().error.heading_rad), 0.06);
      EXPECT_EQ(loop.tracker.mode(), TrackerMode::kHolding);
    }
  }
}

}  // namespace
}  // namespace mocha
