#pragma once

#include <string>
#include <vector>

#include "world/obstacle.h"
#include "world/occupancy_grid.h"

namespace mocha {

/// A stretch of a mover's way: straight at an acceleration along it, or a bend at constant speed.
struct MoverLeg {
  double duration_s;
  double acceleration;  ///< [m/s^2] along the way; 0 in a bend
  double yaw_rate;      ///< [rad/s], positive to the left
};

/// A disc that goes its way and heeds no robot. After its last leg it goes straight on.
struct SceneMover {
  double radius_m;
  Vector2 start;
  double heading_rad;
  double speed;  ///< [m/s]
  std::vector<MoverLeg> legs;
};

struct MoverTruth {
  Vector2 centre;
  Vector2 velocity;  ///< [m/s]
};

/// Where a mover really is, `t` [s] after the scene began.
MoverTruth truth(const SceneMover& mover, double t);

/// A seeded scene for local replanning: a drive straight along x from the origin to the goal, and
/// movers that mostly meet it. Times count from the beginning of the scene.
struct ReplanScene {
  static constexpr int kScenes = 200;
  static constexpr double kRobotRadius_m = 0.3;

  int number;
  std::string group;   ///< constant_velocity or accelerating (also braking and turning)
  std::string kind;    ///< crossing, head_on, overtaking or mixed
  std::string place;   ///< open or corridor
  double start_speed;  ///< [m/s] of the robot, along x
  Vector2 goal;
  Vector2 low;  ///< corners of the known ground
  Vector2 high;
  std::vector<Obstacle> obstacles;
  std::vector<SceneMover> movers;

  /// The scene's map: free but for the obstacles.
  OccupancyGrid grid() const;
};

/// How far along x the robot is expected at time t [s] if nothing is in the way.
double undisturbed_m(const ReplanScene& scene, double t);

/// Scene `number`, from 1 on: the same on every machine.
ReplanScene replan_scene(int number);

}  // namespace mocha
