#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "simulation/blame.h"
#include "simulation/contact_watch.h"
#include "simulation/lidar.h"
#include "simulation/odometry.h"
#include "simulation/pose_history.h"
#include "simulation/ray_grid.h"
#include "simulation/run_record.h"
#include "simulation/vehicle.h"
#include "world/world_file.h"

namespace mocha {

/// One robot of the fleet and everything about it that the simulator knows.
struct SimulatedRobot {
  WorldRobot setup;
  Vehicle vehicle;
  Odometry odometry;
  Lidar lidar;
  RunRecord record;
  PoseHistory past;
  double next_sweep_s;  ///< when the next sweep begins
  double clearance_m;   ///< true footprint to the nearest static or moving obstacle; infinity in an
                        ///< empty world
  unsigned contacts = 0;      ///< events so far
  unsigned own_contacts = 0;  ///< of them, those that are its own

  Obstacle body() const { return placed(setup.model.footprint, vehicle.pose()); }
};

/// An overlap of true footprints began while at least one party was moving.
struct ContactEvent {
  std::string robot;
  std::string other;  ///< a robot, "static" or "moving"
  double depth_m;
  Touch touch;  ///< of `robot`
  Blame blame;  ///< of `robot`
};

/// A fleet in a world, in steps. Seeded: the same steps and commands give the same numbers.
/// Contacts are recorded, but do not push back.
class WorldSimulator {
 public:
  struct RobotScan {
    int robot;
    Scan scan;
  };
  struct StepResult {
    std::vector<RobotScan> scans;  ///< sweeps that ended in this step
    std::vector<ContactEvent> contacts;
  };

  /// Movers set out and lidars begin to sweep at `start_time_s`.
  WorldSimulator(World world, double start_time_s, std::uint64_t seed);

  double time_s() const { return time_s_; }
  const World& world() const { return world_; }
  const std::vector<SimulatedRobot>& robots() const { return robots_; }

  /// Commands a robot from now on. Throws std::invalid_argument unless the values are finite.
  void command(int robot, const Twist& twist);

  /// How the sensors of that robot, or with an empty name of all robots, lie from now on; those of
  /// others do not. Throws std::invalid_argument, and changes nothing, for a robot that is not
  /// there.
  void set_fault(const std::string& robot, const SensorFault& fault);

  /// Moves everything on to `time_s`, which must be later than now, in one step. Absolute times, so
  /// that no rounding adds up.
  StepResult step_to(double time_s);

  /// The moving obstacles now.
  std::vector<Circle> moving_discs() const { return moving_discs(time_s_); }
  /// Smallest distance between the centres of two robots now [m]; infinity for fewer than two.
  double min_separation_m() const;

 private:
  std::vector<Circle> moving_discs(double time_s) const;
  std::vector<Obstacle> seen_by(std::size_t robot, double time_s) const;
  Gap static_gap(const Obstacle& body, const Footprint& footprint, const Vector2& centre) const;
  void check_obstacles(SimulatedRobot& robot, std::vector<ContactEvent>& events);
  void check_movers(SimulatedRobot& robot, std::vector<ContactEvent>& events);
  void check_robots(std::vector<ContactEvent>& events);
  void sweep(std::size_t robot, std::vector<RobotScan>& scans);

  World world_;
  double start_time_s_;
  double time_s_;
  RayGrid walls_;
  std::vector<SimulatedRobot> robots_;
  ContactWatch watch_;
};

}  // namespace mocha
