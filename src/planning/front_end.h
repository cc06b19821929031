#pragma once

#include <optional>
#include <vector>

#include "planning/opening.h"
#include "planning/planner_rules.h"
#include "planning/planning_scene.h"
#include "topology/ways.h"
#include "world/robot_model.h"

namespace mocha {

/// One class of ways to the goal and how to begin on it.
struct Approach {
  std::vector<Opening> openings;  ///< at least one; what is to be preferred comes first
  double least_length_m;          ///< of every drive of this class, proved
  Signature signature;
};

struct Approaches {
  std::vector<Approach> list;       ///< cheapest first
  Cuts<2> cuts{{}};                 ///< that tell their classes apart
  std::optional<Signature> driven;  ///< class of the plan that is being driven to the same goal
};

/// How ways are searched for this robot.
WayRules way_rules(const RobotModel& robot, const PlannerRules& rules);

/// Places on a motion from a time on to its end, at most 0.2 m apart at speeds up to `max_speed`.
std::vector<Vector2> path_of(const Motion& motion, double from_s, double max_speed);

/// Finds the ways to the goal, cheapest first (IV-E).
class FrontEnd {
 public:
  FrontEnd(const RobotModel& robot, const PlannerRules& rules, double rest_acceleration);

  /// Those that the robot can begin as it moves; where it has to brake first, those from where it
  /// then stands, of the classes that remain.
  Approaches approaches(const PlanQuery& query, const PlanningScene& scene,
                        const Vector2& goal) const;

  /// Those after braking only, for a robot that moves; else none.
  Approaches after_braking(const PlanQuery& query, const PlanningScene& scene,
                           const Vector2& goal) const;

  /// Whether there is any way, team-mates aside.
  bool reaches(const Vector2& start, const Vector2& goal, const Terrain& terrain) const;

  /// Distance of the robot's centre from obstacles on a way [m].
  double required_clearance_m() const { return rules_.travel.required_clearance_m; }

  const Openings& openings() const { return openings_; }

 private:
  Ways ways(std::vector<Vector2> lead_in, const PlanQuery& query, const PlanningScene& scene,
            const Vector2& goal) const;

  const RobotModel robot_;
  WayRules rules_;
  const Openings openings_;
  const double rest_acceleration_;
};

}  // namespace mocha
