#pragma once

#include <optional>
#include <vector>

#include "planning/candidates/local_scene.h"
#include "safety/requirement.h"
#include "world/robot_model.h"

namespace mocha {

/// What a maneuver begins from, and when what is decided now takes over. Absolute times; the
/// settled one is a switch time of the committed motion.
struct ManeuverStart {
  const RobotModel& robot;
  const Requirements& requirements;
  const LocalScene& scene;
  Course course;            ///< of what moves, that the maneuver is to keep clear of
  const Motion& committed;  ///< not empty
  double now_s;
  double emergency_s;      ///< as an emergency, which binds at once
  double settled_s;        ///< after settling with the peers
  Vector2 target;          ///< on the plan, which the robot is to get to
  double promise_reach_m;  ///< from where it is, it promises no farther
};

/// What a maneuver is until it brakes.
enum class Follows { kCommitted, kPlan, kNothing };

/// A motion that a robot might promise instead of what it has promised. Nothing is proved of it.
struct Maneuver {
  double join_s;  ///< here it leaves the committed motion, or goes on with it
  Motion motion;  ///< from join_s on
  /// Only the part of it up to a time between these is promised, and then braking; both after its
  /// end where all of it is.
  double brake_from_s;
  double brake_until_s;
  double least_reach_s;            ///< a part that brakes earlier is not worth a message
  std::optional<Braking> braking;  ///< none where all is promised
  bool at_once;                    ///< binds as an emergency, without settling
  Follows follows;
  const char* words;  ///< for reports
};

using Maneuvers = std::vector<Maneuver>;

/// The maneuver that is the whole of a motion.
Maneuver whole(Motion motion, double join_s, bool at_once, const char* words);

/// No peer is so near that it could be about to promise, unheard yet, what an emergency takes.
bool is_alone(const ManeuverStart& start);

}  // namespace mocha
