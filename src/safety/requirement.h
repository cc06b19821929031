#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "safety/leaving.h"
#include "safety/scene.h"
#include "safety/stop_proof.h"
#include "world/robot_model.h"
#include "world/speed_margin.h"

namespace mocha {

/// Which prediction of a thing that promises nothing a motion is held against.
enum class Course {
  kConfident,  ///< the disc that holds it with the confidence that is asked for
  kLikely,     ///< the disc on its most likely course
};

/// The requirements that have a name. Of those for detours, the earlier one asks for more.
enum class RequirementName {
  /// A plan to the goal: limits of driving, static margin. Unseen space counts as free; what moves
  /// is left to the replanner.
  kPlan,
  /// A detour, up to where it is back on the plan: as a plan, and apart from all that moves.
  kDetour,
  /// The same, past the likely course of what moves.
  kDetourLikely,
  /// The same within the limits of an emergency.
  kEmergencyDetour,
  /// A new promise: as a detour, inside space that was seen free, and so that the robot and its
  /// peers can stop for each other at any moment.
  kPromise,
  /// The same, past the likely course of what moves.
  kPromiseLikely,
  /// A promise in force, for its lease. Its peers settle with exactly the distance that is
  /// required; the margin of the map and a part of the clearance to people may be used up.
  kRenewal,
  /// An emergency motion: as a promise on the likely course, within the limits of an emergency.
  kEmergency,
  /// An emergency motion where nothing keeps clear of the predictions: these are not asked for.
  kEscape,
  /// What starts a detour where the plan violates it, paper (37): as a promise, with a part of the
  /// clearance to people.
  kTrigger,
  /// The same, on the likely course.
  kTriggerLikely,
  kNone,  ///< nothing is met
};

/// In words, for reports.
const char* to_text(RequirementName name);

/// What a motion must keep in order to be certified. A value: the named ones come from
/// Requirements, and a caller sets the stretch of time.
struct Requirement {
  std::optional<MotionLimits> limits;  ///< with those of speed zones; none: not asked
  SpeedMargin obstacle_margin;         ///< of the footprint, to occupied space
  /// Of the footprint, to space that was never seen; none: such space counts as free.
  std::optional<SpeedMargin> unseen_margin;
  Leaving leaving;  ///< how a motion that begins closer than these margins may go on
  /// Of the centre, to the rim of a peer's disc; none: peers are not asked for.
  std::optional<double> peer_distance_m;
  /// How the robot and its peers are to be able to stop for each other, and what their discs then
  /// keep; none: not asked.
  std::optional<StopOptions> stops;
  double stop_clearance_m = 0.0;
  /// Of the centre, to the rim of a predicted disc; none: predictions are not asked for.
  std::optional<double> predicted_distance_m;
  Course course = Course::kConfident;
  double reserve_s = 0.0;  ///< at the end of the predictions, of which nothing is asked

  // The stretch of time, absolute.
  double from_s = -std::numeric_limits<double>::infinity();
  double until_s = std::numeric_limits<double>::infinity();  ///< of the first violation that counts
  /// Limits are asked for from here on: what is in force until then was certified before.
  double limits_from_s = -std::numeric_limits<double>::infinity();

  /// The same for the stretch from `from` on.
  Requirement from(double from) const;
  /// The same, with limits asked for from `join` on only.
  Requirement joining_at(double join) const;
  /// The same up to `until`.
  Requirement until(double until) const;
};

/// The named requirements of one robot.
class Requirements {
 public:
  explicit Requirements(const RobotModel& robot);

  /// `name` must not be kNone.
  const Requirement& operator[](RequirementName name) const {
    return list_[static_cast<std::size_t>(name)];
  }

 private:
  Requirement& at(RequirementName name) { return list_[static_cast<std::size_t>(name)]; }

  std::array<Requirement, static_cast<std::size_t>(RequirementName::kNone)> list_;
};

/// The moving things that a requirement keeps a motion from, and how far.
std::vector<MovingThing> kept_apart(const Scene& scene, const Requirement& requirement);

/// The distance from a robot's centre to the rim of a peer's disc that promises keep [m].
double distance_to_peers_m(const RobotModel& robot);

}  // namespace mocha
