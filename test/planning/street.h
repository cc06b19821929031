#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "planning/closed_loop.h"
#include "world/moving/prediction.h"

namespace mocha {

/// A person that goes straight legs and heeds no robot; after the last one, stands.
struct Walker {
  struct Leg {
    double duration_s;
    Vector2 velocity;
  };
  Vector2 start;
  std::vector<Leg> legs;
  double radius_m = 0.25;
  double appears_s = 0.0;  ///< not seen before; times are those since the beginning

  Vector2 place(double t) const {
    Vector2 place = start;
    for (const Leg& leg : legs) {
      place += std::clamp(t, 0.0, leg.duration_s) * leg.velocity;
      t -= leg.duration_s;
    }
    return place;
  }
  Vector2 velocity(double t) const {
    for (const Leg& leg : legs) {
      if (t >= 0.0 && t < leg.duration_s) return leg.velocity;
      t -= leg.duration_s;
    }
    return Vector2::Zero();
  }
};

/// The closed loop of a rover (or another robot) among people, which are predicted from what they
/// do at each step. Their true discs are watched every 10 ms.
class Street {
 public:
  Street(const OccupancyGrid& world, const Vector2& goal, std::vector<Walker> walkers = {},
         const RobotModel& robot = rover())
      : walkers(std::move(walkers)),
        loop(robot, world, Vector2::Zero(), goal),
        robot_radius_m_(robot.footprint.circumscribed_radius_m()) {
    begin_s_ = loop.now_s;
  }

  /// On the way along x at full speed from the first step on.
  void begin_rolling(double speed = 0.9) {
    constexpr double kAcceleration = 0.5;
    const double ramp_s = speed / kAcceleration;
    const Motion drive = straight_drive(begin_s_, Vector2::Zero(), 0.0, 4.0, speed, kAcceleration);
    const double behind_m = drive.at(begin_s_ + ramp_s).pose.position.x();
    loop.begin_with(
        straight_drive(begin_s_ - ramp_s, {-behind_m, 0.0}, 0.0, 4.0, speed, kAcceleration));
  }

  double t() const { return loop.now_s - begin_s_; }
  Vector2 here() const { return loop.state().pose.position; }

  void step() {
    predict_people(t() + ClosedLoop::kStep_s);
    loop.step();
    const auto& local = loop.output.local;
    if (local) {
      ++swerves_tried;
      candidates += static_cast<int>(local->candidates.size());
      const bool taken = loop.output.swerves;
      swerves += taken;
      switches += taken && t() < swerved_s_ + 2.0 && local->switches_class;
      if (taken) swerved_s_ = t();
    }
    watch();
  }
  void run(double time_s) {
    for (const double end_s = t() + time_s; t() < end_s - 1e-6;) step();
  }
  bool run_to_goal(double longest_s) {
    for (const double end_s = t() + longest_s; t() < end_s;) {
      step();
      if ((here() - loop.goal).norm() < 0.15 && loop.standing()) return true;
    }
    return false;
  }

  std::vector<Walker> walkers;
  ClosedLoop loop;
  double noise_m = 0.0;  ///< of the places and velocities that are predicted
  double noise_mps = 0.0;
  std::mt19937 random;  ///< that the noise is drawn from

  double least_gap_m = std::numeric_limits<double>::infinity();  ///< between the true discs
  double least_speed = 0.0;    ///< [m/s] along the heading; negative where it drove backward
  double contact_speed = 0.0;  ///< [m/s] at which the robot itself runs into a person, the highest
  int yaw_swings = 0;          ///< from turning one way to turning the other
  int swerves_tried = 0;
  int swerves = 0;   ///< taken
  int switches = 0;  ///< to another class in the midst of a detour
  int candidates = 0;

 private:
  void predict_people(double t) {
    constexpr double kPlace_m = 0.03;  // standard deviations that a tracker names
    constexpr double kVelocity = 0.05;
    Predictions predictions{begin_s_ + t};
    for (const Walker& walker : walkers) {
      if (t < walker.appears_s) continue;
      const auto id = static_cast<std::uint32_t>(predictions.things.size() + 1);
      predictions.things.push_back({id,
                                    walker.place(t) + noise(noise_m),
                                    walker.velocity(t) + noise(noise_mps),
                                    walker.radius_m,
                                    {std::max(kPlace_m, noise_m), std::max(kVelocity, noise_mps)}});
    }
    loop.moving = confident_discs(predictions, 0.8, {0.2, 2.0, 0.0, 1.0, 0.3});
    loop.expected = likely_discs(predictions);
  }
  Vector2 noise(double deviation) {
    const double x = normal_(random);
    return deviation * Vector2(x, normal_(random));
  }

  /// What is promised until the next step is driven.
  void watch() {
    constexpr double kTurns_radps = 0.15;
    const Motion& motion = loop.committed();
    if (motion.empty()) return;
    for (double later_s = 0.0; later_s < ClosedLoop::kStep_s - 1e-6; later_s += 0.01) {
      const MotionState state = motion.at(loop.now_s + later_s);
      least_speed = std::min(least_speed, state.speed);
      for (const Walker& walker : walkers) {
        if (t() + later_s < walker.appears_s) continue;
        const Vector2 apart = walker.place(t() + later_s) - state.pose.position;
        const double gap_m = apart.norm() - walker.radius_m - robot_radius_m_;
        least_gap_m = std::min(least_gap_m, gap_m);
        if (gap_m < 0.0)
          contact_speed = std::max(contact_speed, state.velocity.dot(apart.normalized()));
      }
      if (std::abs(state.yaw_rate) < kTurns_radps) continue;
      const int turns = state.yaw_rate > 0.0 ? 1 : -1;
      yaw_swings += turns_ * turns < 0;
      turns_ = turns;
    }
  }

  const double robot_radius_m_;
  double begin_s_;
  double swerved_s_ = -10.0;
  int turns_ = 0;
  std::normal_distribution<double> normal_;
};

}  // namespace mocha
