#pragma once

#include <optional>
#include <vector>

#include "trajectory/minco.h"
#include "trajectory/motion.h"
#include "world/robot_model.h"

namespace mocha {

/// Between velocity and path; beyond, the robot brakes before it turns there.
inline constexpr double kRollingStart_rad = 1.2;

/// Between two parts of a path; beyond, no drive leads from one to the other.
inline constexpr double kTurnsBack_rad = 1.9;

/// Which way drives may go.
enum class Drives { kForward, kEitherWay };

/// How a plan may begin before its optimised drive (brake, turn in place, or nothing), and the path
/// of that drive.
struct StartManeuver {
  std::vector<Phase> phases;
  double duration_s = 0.0;
  int direction = 1;          ///< of the drive: +1 forward, -1 backward
  PlanarMinco::State state;   ///< where the drive begins
  std::vector<Vector2> path;  ///< from there to the goal
};

/// Acceleration [m/s^2] at which drives from rest begin and end, so that their heading there is
/// well defined.
double rest_acceleration(const MotionLimits& limits);

/// In place, to a heading; none for changes so small that a drive can take them.
std::optional<TurnPhase> turn_in_place(const Pose& pose, double yaw_rad,
                                       const MotionLimits& limits);

/// The start maneuvers of one robot.
class StartManeuvers {
 public:
  StartManeuvers(const MotionLimits& limits, double smooth_start_rad)
      : limits_(limits), smooth_start_rad_(smooth_start_rad) {}

  /// From rest at `pose`, after `before`: at once where the path lies ahead, or after a turn in
  /// place; what is to be preferred comes first. Either way: backward before forward where that
  /// takes a smaller turn.
  std::vector<StartManeuver> from_rest(const std::vector<Phase>& before, const Pose& pose,
                                       const std::vector<Vector2>& path,
                                       Drives drives = Drives::kForward) const;

  /// Out of a drive; nothing where the path turns away too sharply, or that drive goes the way that
  /// is not allowed, so that the robot has to brake first.
  std::vector<StartManeuver> rolling(const MotionState& state, const std::vector<Vector2>& path,
                                     Drives drives = Drives::kForward) const;

 private:
  void add_from_rest(const std::vector<Phase>& before, const Pose& pose,
                     const std::vector<Vector2>& path, int direction,
                     std::vector<StartManeuver>& start_maneuvers) const;
  StartManeuver start_maneuver(std::vector<Phase> phases, const Pose& end,
                               const std::vector<Vector2>& path, int direction) const;

  const MotionLimits limits_;
  const double smooth_start_rad_;
};

}  // namespace mocha
