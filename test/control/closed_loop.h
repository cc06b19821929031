#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <vector>

#include "control/trajectory_tracker.h"
#include "trajectory/minco.h"

namespace mocha::closed_loop {

inline RobotModel rover() { return load_robot_model("config", "rover"); }
inline RobotModel jackal() { return load_robot_model("config", "jackal"); }

/// A differential drive with lagging wheels, in steps of 1 ms.
class SimulatedRobot {
 public:
  /// Its wheels turn at `gain` times the commanded speed.
  SimulatedRobot(const RobotModel& model, const Pose& start, double gain = 1.0)
      : model_(model), pose_(start), gain_(gain) {}

  void advance(const UnicycleState& command, double duration) {
    constexpr double kStep_s = 0.001;
    const WheelSpeeds wanted = wheel_speeds(command, model_.limits.track_m);
    for (int i = 0; i < static_cast<int>(std::lround(duration / kStep_s)); ++i) {
      turn_wheel(wheels_.left, wanted.left, kStep_s);
      turn_wheel(wheels_.right, wanted.right, kStep_s);
      pose_ = predict({0.0, pose_, twist()}, kStep_s);
    }
  }

  void push(const Vector2& by_m) { pose_.position += by_m; }

  const Pose& pose() const { return pose_; }
  UnicycleState twist() const { return from_wheel_speeds(wheels_, model_.limits.track_m); }

 private:
  void turn_wheel(double& speed, double wanted, double dt) const {
    wanted =
        std::clamp(gain_ * wanted, -model_.limits.max_wheel_speed, model_.limits.max_wheel_speed);
    const double limit = model_.max_wheel_acceleration;
    speed += dt * std::clamp((wanted - speed) / model_.actuator_lag_s, -limit, limit);
  }

  RobotModel model_;
  Pose pose_;
  double gain_;
  WheelSpeeds wheels_ = {0.0, 0.0};
};

struct Noise {
  double position_m = 0.004;
  double heading_rad = 0.004;
  double speed = 0.01;     ///< [m/s]
  double yaw_rate = 0.02;  ///< [rad/s]
};

/// Measurements with white noise on them.
class Sensor {
 public:
  Sensor(const Noise& noise, unsigned seed) : noise_(noise), random_(seed) {}

  RobotState measure(const SimulatedRobot& robot, double t) {
    RobotState state{t, robot.pose(), robot.twist()};
    state.pose.position += Vector2(draw(noise_.position_m), draw(noise_.position_m));
    state.pose.yaw_rad += draw(noise_.heading_rad);
    state.twist.speed += draw(noise_.speed);
    state.twist.yaw_rate += draw(noise_.yaw_rate);
    return state;
  }

 private:
  double draw(double deviation) { return deviation * std::normal_distribution<double>()(random_); }

  Noise noise_;
  std::mt19937 random_;
};

/// One control period as it was.
struct Sample {
  double t;
  TrackerMode mode;
  Pose pose;
  UnicycleState twist;
  UnicycleState command;
  TrackingError error;  ///< true, not measured
};

constexpr double kPeriod_s = 0.02;

/// A tracker, a robot and a sensor in one loop, with leases that never end unless a test says
/// otherwise.
struct ClosedLoop {
  ClosedLoop(const RobotModel& model, const Pose& start, unsigned seed, const Noise& noise = {})
      : tracker(TrackerParameters(), model), robot(model, start), sensor(noise, seed) {}

  /// Runs until `end`; returns what happened. No measurement arrives at the times that are `blind`.
  std::vector<Sample> run(double end) {
    std::vector<Sample> samples;
    for (; t < end; t += kPeriod_s) {
      if (!blind(t)) measured = sensor.measure(robot, t);
      const UnicycleState command = tracker.step(t, measured);
      Sample sample{t, tracker.mode(), robot.pose(), robot.twist(), command, {}};
      if (!tracker.motion().empty()) {
        sample.error = tracking_error(robot.pose(), tracker.motion().at(t).pose);
      }
      samples.push_back(sample);
      robot.advance(command, kPeriod_s);
    }
    return samples;
  }

  TrajectoryTracker tracker;
  SimulatedRobot robot;
  Sensor sensor;
  std::optional<RobotState> measured;
  double t = 0.0;
  std::function<bool(double)> blind = [](double) { return false; };
};

inline double worst_position_error(const std::vector<Sample>& samples) {
  double worst = 0.0;
  for (const Sample& sample : samples) worst = std::max(worst, sample.error.position_m());
  return worst;
}

/// Changes between left and right in the commanded yaw rate from time t on.
inline int yaw_sign_changes(const std::vector<Sample>& samples, double t) {
  int changes = 0;
  double last = 0.0;
  for (const Sample& sample : samples) {
    if (sample.t < t || std::abs(sample.command.yaw_rate) < 1e-3) continue;
    if (last * sample.command.yaw_rate < 0.0) ++changes;
    last = sample.command.yaw_rate;
  }
  return changes;
}

/// A straight drive along the heading from rest to rest, 1.875 distance / duration at its fastest.
inline DrivePhase straight(const Pose& start, int direction, double distance, double duration) {
  const Vector2 along =
      direction * distance * Vector2(std::cos(start.yaw_rad), std::sin(start.yaw_rad));
  PlanarMinco minco;
  minco.resize(1);
  PlanarMinco::State from = PlanarMinco::State::Zero();
  PlanarMinco::State to = PlanarMinco::State::Zero();
  from.col(0) = start.position;
  to.col(0) = start.position + along;
  minco.solve(from, to, PlanarMinco::Knots(2, 0), Eigen::VectorXd::Constant(1, duration));
  return {direction, minco.curve()};
}

/// Worst ratio to the limits of speed, acceleration and yaw rate along a drive; a stretch by it in
/// time makes it feasible.
inline double demand(const DrivePhase& drive, const MotionLimits& limits) {
  double worst = 0.0;
  const Motion motion(0.0, {drive});
  for (double t = 0.0; t <= motion.end_time(); t += 0.01) {
    const MotionState state = motion.at(t);
    worst = std::max({worst, std::abs(state.speed) / limits.max_speed,
                      std::sqrt(state.acceleration.norm() / limits.max_acceleration),
                      std::abs(state.yaw_rate) / limits.max_yaw_rate});
  }
  return worst;
}

/// A winding drive of 3 to 8 m from rest to rest that just keeps within the limits.
inline DrivePhase winding(const MotionLimits& limits, int direction, std::mt19937& random) {
  std::uniform_real_distribution<double> step(0.6, 1.4), turn(-0.9, 0.9), any(-M_PI, M_PI);
  const int pieces = std::uniform_int_distribution<int>(5, 7)(random);
  std::vector<Vector2> points = {Vector2(0.0, 0.0)};
  double heading = any(random);
  for (int i = 0; i < pieces; ++i, heading += turn(random)) {
    points.push_back(points.back() + step(random) * Vector2(std::cos(heading), std::sin(heading)));
  }
  PlanarMinco minco;
  minco.resize(pieces);
  PlanarMinco::State from = PlanarMinco::State::Zero();
  PlanarMinco::State to = PlanarMinco::State::Zero();
  from.col(0) = points.front();
  to.col(0) = points.back();
  PlanarMinco::Knots knots(2, pieces - 1);
  Eigen::VectorXd durations(pieces);
  for (int i = 0; i < pieces; ++i) {
    if (i > 0) knots.col(i - 1) = points[i];
    const bool at_an_end = i == 0 || i == pieces - 1;
    durations[i] = (points[i + 1] - points[i]).norm() * (at_an_end ? 2.0 : 1.0);
  }
  minco.solve(from, to, knots, durations);
  DrivePhase drive{direction, minco.curve()};
  drive.path = drive.path.stretched(demand(drive, limits));
  return drive;
}

inline Pose start_of(const DrivePhase& drive) {
  return {drive.path.position(0.0), heading(drive, 0.0)};
}

}  // namespace mocha::closed_loop
