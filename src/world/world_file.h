#pragma once

#include <Eigen/Geometry>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "world/goal.h"
#include "world/obstacle.h"
#include "world/robot_model.h"
#include "world/zones.h"

namespace mocha {

/// All that a world file may hold.
inline constexpr std::initializer_list<const char*> kWorldKeys = {
    "bounds", "optimal_time", "circles", "polygons", "keep_out", "speed_zones", "moving", "robots"};

/// A world file cannot be used. what() names file, key and value in one line.
class WorldError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Where a mover is at a time [s] after it set out.
struct Keyframe {
  double time_s;
  Vector2 place;
};

/// What becomes of a mover after its last keyframe.
enum class AfterLast {
  kStands,  ///< there, as it does at the first one before it sets out
  kLeaves,  ///< it is in the world from its first keyframe to its last only
  kRepeats  ///< is at its first one again
};

/// A disc that goes straight on from one keyframe to the next, each at constant speed. There is at
/// least one, two where it leaves or repeats; their times ascend and none is negative.
struct Mover {
  double radius_m;
  std::vector<Keyframe> keyframes;
  AfterLast after_last;
};

/// Of a mover that travels at a constant speed along a path of at least one point. In a loop, it
/// goes from the last point straight on to the first, and so on; else it stands at the last.
Mover along_path(double radius_m, double speed_mps, bool loop, std::vector<Vector2> path);

struct WorldRobot {
  std::string name;
  RobotModel model;  ///< with the footprint that the world file asks for
  Pose start;
  std::optional<Goal> goal;
};

/// What a world file says. Map frame, SI units.
struct World {
  Eigen::AlignedBox2d bounds;
  std::optional<double>
      optimal_time_s;  ///< of BARN worlds: they count as reached within 1 m of the goal
  std::vector<Circle> circles;
  std::vector<Polygon> polygons;
  Zones zones;  ///< not solid
  std::vector<Mover> moving;
  std::vector<WorldRobot> robots;
};

/// Loads a world; `config_directory` holds robot.yaml and robots/<model>.yaml. Throws WorldError
/// for whatever is missing, misspelt, not finite or impossible, and for robots whose true footprint
/// overlaps an obstacle or another robot at the start.
World load_world(const std::string& path, const std::string& config_directory);

}  // namespace mocha
