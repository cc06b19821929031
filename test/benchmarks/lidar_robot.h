#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/lidar_perception.h"
#include "control/trajectory_tracker.h"
#include "fleet/protocol/commitment_protocol.h"
#include "simulation/world_simulator.h"
#include "stack/robot_stack.h"
#include "world/distances/distance_field.h"

namespace mocha {

/// One robot with all that its nodes do, from its simulated lidar to its wheels, in simulated time
/// and without ROS. It is told where it is, and knows of the world what its lidar has seen. All
/// parameters are those of config/, but for retry_period: 2 s.
class LidarRobot {
 public:
  static constexpr double kTick_s = 0.01;

  /// The first robot of a world; `seed`: of the lidar's noise.
  LidarRobot(const World& world, std::uint64_t seed);

  void go_to(const Vector2& goal);
  /// Everything moves on by kTick_s.
  void tick();

  double now_s() const;
  const SimulatedRobot& truth() const { return simulator_.robots()[0]; }
  /// Of its goal.
  GoalExecutive::Ending ending() const { return ending_; }
  /// What it said last that keeps it from its goal, and what it was doing.
  const std::string& words() const { return words_; }
  double slowest_plan_s() const { return slowest_plan_s_; }  ///< wall time

  const WorldSimulator& simulator() const { return simulator_; }
  const RobotStack& stack() const { return stack_; }
  /// Discs that hold what moves around it, as far as it knows.
  Discs confident() const;
  /// Contacts that began in the last tick.
  const std::vector<ContactEvent>& contacts() const { return contacts_; }

 private:
  void simulate();
  void perceive(const Scan& scan);
  void take_map(const OccupancyGrid& grid);
  void pursue();
  void replan();
  void drive();
  void note();
  RobotState measured() const;
  LocalScene scene() const;

  const RobotModel robot_;
  WorldSimulator simulator_;
  LidarPerception perception_;
  const ParameterTable local_values_ = ParameterTable::from_schema("config/local_replanner.yaml");
  const Reach reach_;
  CommitmentProtocol protocol_;
  RobotStack stack_;
  TrajectoryTracker tracker_;

  int ticks_ = 0;
  std::vector<ContactEvent> contacts_;
  std::vector<Vector2> places_;  // that the map is to hold: the robot's, and its goal
  std::shared_ptr<const StaticMap> static_map_;
  std::shared_ptr<const DistanceField> unseen_;
  Predictions predictions_;
  MotionId offered_;
  GoalExecutive::Ending ending_ = GoalExecutive::Ending::kNone;
  std::string words_;
  double slowest_plan_s_ = 0.0;
};

}  // namespace mocha
