#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "optimization/duration_cost.h"
#include "optimization/moving_penalty.h"
#include "optimization/trajectory_optimizer.h"
#include "planning/candidates/drive_options.h"
#include "planning/candidates/fallback.h"
#include "planning/candidates/speed_profile.h"
#include "safety/certificate.h"
#include "world/obstacle_field.h"
#include "world/robot_model.h"
#include "world/speed_margin.h"
#include "world/speed_zones.h"

namespace mocha {

/// A drive to be found: from a state of the base along a front-end path to rest at its end, or to
/// the rejoin point there.
struct DriveQuery {
  std::vector<Vector2> path;        ///< at least two points; the first is the start's position
  PlanarMinco::State start;         ///< position, velocity, acceleration
  double start_time_s;              ///< absolute
  std::vector<MovingThing> moving;  ///< and what is proved to be kept from it
  /// When the path is at its points, from 0 [s], increasing; empty: as early as the limits allow.
  std::vector<double> times_s;
  /// Where it meets a motion that is under way, paper (38), instead of coming to rest: position,
  /// velocity, acceleration.
  std::optional<PlanarMinco::State> rejoin;
  DurationCost duration_cost;
  std::optional<MotionLimits> limits;  ///< in place of the robot's own
  /// Of a drive that was found before and nearly serves; the first attempt begins there instead of
  /// on the path.
  std::optional<InitialKnots<2>> found_before = std::nullopt;
  int direction = 1;                                   ///< +1 forward, -1 backward
  std::shared_ptr<const SpeedZones> speed_zones = {};  ///< null: none
};

/// How hard the optimiser tries to satisfy the constraints; raised step by step where a result is
/// not certified.
struct Effort {
  bool from_found = true;  ///< begins at what was found before, if anything was
  /// Why waypoints are the variables; nothing: camouflage, one variable a knot.
  std::optional<Fallback> fallback = std::nullopt;
  double spacing = 1.0;          ///< of the knots, relative to the options
  double obstacle_weight = 1.0;  ///< the same, as all that follows
  double moving_weight = 1.0;
  double limit_weight = 1.0;  ///< of speed, acceleration and yaw rate
  double speed = 1.0;         ///< relative to the robot's limit
};

/// More effort, by the factor, where it is missing: against obstacles, against what moves, or
/// against the limits of the robot.
Effort raised(const Effort& effort, const Violation& violation, double factor);

/// A drive, and what the optimiser fell back on to find it.
struct OptimizedDrive : OptimizedTrajectory<2, 3> {
  std::vector<Fallback> fallbacks;
};

/// Turns front-end paths into smooth drives: MINCO through knots that camouflage moves, paper (14).
class DriveOptimizer {
 public:
  DriveOptimizer(const RobotModel& robot, const DriveOptions& options,
                 const SpeedMargin& static_margin);

  /// `field` are the static obstacles. The result's curve is empty only if nothing finite was
  /// found (kNotFinite), or the query is none (kInvalidInput): values that are not finite or beyond
  /// 1e6, fewer than two points, no length. Cost and terms are those at the weights of the options,
  /// whatever the effort. `most_work`: evaluations of single pieces; one of the whole is made in
  /// any case.
  OptimizedDrive optimize_drive(const DriveQuery& query, const ObstacleField<2>& field,
                                const Effort& effort, const std::function<bool()>& should_stop,
                                double most_work = std::numeric_limits<double>::infinity()) const;

 private:
  const MotionLimits& limits_of(const DriveQuery& query) const;
  /// How fast the base may be there, about, in the direction in which it needs the least room, and
  /// a little aside where that is what it lacks [m/s]; a place where it may not be at all says
  /// nothing.
  double fastest_at(const Vector2& place, const ObstacleField<2>& field) const;
  /// Whether there is a place on the path where the base has to be slower than it can.
  bool is_narrow(const std::vector<Vector2>& path, const ObstacleField<2>& field) const;
  InitialKnots<2> initial_knots(const DriveQuery& query, const ObstacleField<2>& field,
                                const Effort& effort) const;
  PlanarMinco::State end_state(const DriveQuery& query) const;
  /// Sets the fallback where there is none yet, and camouflage is not possible.
  std::shared_ptr<const KnotMap<2>> knot_map(const Eigen::Matrix2Xd& path,
                                             const ObstacleField<2>& field,
                                             std::optional<Fallback>& fallback) const;
  std::vector<std::unique_ptr<Penalty<2>>> penalties(const DriveQuery& query,
                                                     const ObstacleField<2>& field,
                                                     const Effort& effort) const;

  const RobotModel robot_;
  const DriveOptions options_;
  const SpeedMargin static_margin_;
};

}  // namespace mocha
