#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "planning/candidates/pipeline.h"
#include "planning/candidates/planning_scene.h"
#include "planning/global/planner_options.h"
#include "topology/paths/homotopy_paths.h"
#include "topology/paths/narrowest_place.h"
#include "world/robot_model.h"

namespace mocha {

struct GlobalSeeds {
  std::vector<Seed> list;           ///< cheapest first
  Cuts<2> cuts{{}};                 ///< that tell their classes apart
  std::optional<Signature> driven;  ///< class of the plan that is being driven to the same goal
};

/// How paths are searched for this robot.
HomotopyPathOptions homotopy_path_options(const RobotModel& robot, const PlannerOptions& options);

/// Places on a motion from a time on to its end, at most 0.2 m apart at speeds up to `max_speed`.
std::vector<Vector2> path_of(const Motion& motion, double from_s, double max_speed);

/// Finds the paths to the goal, cheapest first (paper IV-E). Where it is stopped, what it says is
/// of no account.
class FrontEnd {
 public:
  FrontEnd(const RobotModel& robot, const PlannerOptions& options);

  /// Of those of seeds(), for a robot that drives a plan, the path of the driven class and those
  /// that may be worth a switch. None where there is no such plan, it is not possible any more, or
  /// team-mates move, whatever their promises cost.
  GlobalSeeds promising(const PlanQuery& query, const PlanningScene& scene,
                        const Vector2& goal) const;

  /// Those that the robot can begin as it moves; where it has to brake first, those from where it
  /// then stands, of the classes that remain.
  GlobalSeeds seeds(const PlanQuery& query, const PlanningScene& scene, const Vector2& goal) const;

  /// Those after braking only, for a robot that moves; else none.
  GlobalSeeds after_braking(const PlanQuery& query, const PlanningScene& scene,
                            const Vector2& goal) const;

  /// Those after a way out of a tight place, for a robot that rests in one; else none.
  GlobalSeeds after_parking_out(const PlanQuery& query, const PlanningScene& scene,
                                const Vector2& goal) const;

  /// False only where no path can lead to the goal, team-mates or not; takes no search.
  bool may_reach(const Vector2& start, const Vector2& goal, const StaticMap& static_map) const;

  /// Whether there is any path, team-mates aside.
  bool reaches(const Vector2& start, const Vector2& goal, const StaticMap& static_map,
               const std::function<bool()>& should_stop) const;

  /// The place nearest to the goal to which there is a path, team-mates aside; `start` where there
  /// is none.
  Vector2 nearest_reachable(const Vector2& start, const Vector2& goal, const StaticMap& static_map,
                            const std::function<bool()>& should_stop) const;

  /// Where the widest way to the goal is too narrow for the robot, team-mates aside; nothing where
  /// there is none at all.
  std::optional<NarrowPlace> narrowest(const Vector2& start, const Vector2& goal,
                                       const StaticMap& static_map,
                                       const std::function<bool()>& should_stop) const;

  /// Distance of the robot's centre from obstacles on a path [m].
  double required_clearance_m() const { return options_.travel.required_clearance_m; }

 private:
  /// Where the robot's base must not be because of team-mates that stand at time t [s].
  std::vector<BlockedDisc> standing_peers(const PlanningScene& scene, double t) const;
  HomotopyPaths paths(std::vector<Vector2> lead_in, const PlanQuery& query,
                      const PlanningScene& scene, const Vector2& goal,
                      std::optional<double> below_driven = std::nullopt) const;
  /// Of what can be begun as the robot moves.
  GlobalSeeds under_way(const MotionState& start, HomotopyPaths found, Drives drives) const;
  /// Those from where what comes before ends at rest.
  GlobalSeeds after(const std::vector<Phase>& before, const PlanQuery& query,
                    const PlanningScene& scene, const Vector2& goal) const;
  /// Along a path that is given, backward, too: team-mates wait meanwhile.
  Drives drives_of(const PlanQuery& query) const;
  /// What the path costs is at least the time that its least length takes at the robot's limits of
  /// speed and acceleration.
  Seed seed_of(const HomotopyPath& path, std::vector<StartManeuver> start_maneuvers,
               const std::optional<Signature>& driven) const;

  const RobotModel robot_;
  const HomotopyPathOptions options_;
  const StartManeuvers start_maneuvers_;
  const double weight_duration_;
  const double below_driven_;  ///< see promising()
};

}  // namespace mocha
