#pragma once

#include <vector>

#include "safety/requirement.h"

namespace mocha {

/// What a robot that has promised a motion is in.
enum class Situation {
  kHolds,       ///< the promise is certified, and the plan meets nothing that moves
  kPlanMeets,   ///< the promise is certified, but the plan meets something that moves, paper (37)
  kInTurn,      ///< the promise is certified, and others count on the robot's way (PlanKind)
  kThreatened,  ///< under way, the promise meets something that moves
  kBlocked,     ///< under way, the promise violates anything else
  kInTheWay,    ///< the robot stands, though it wants to go on, in the way of something that moves
  kNoGoal,      ///< there is nothing to drive to, but the robot moves or is about to
};

/// What is done in a step. The values are those of ReplannerStatus.msg.
enum class Row {
  kKeep = 0,           ///< nothing: what is promised is kept
  kWait = 1,           ///< nothing, until the proposal at hand is answered
  kStand = 2,          ///< promises to stand where it stands, without a promise so far
  kStopHere = 3,       ///< brakes from where it is, off its motion or without one
  kStopBlind = 4,      ///< brakes along its motion, as nothing can be certified without data
  kEmergencyStop = 5,  ///< says how an emergency stop brakes
  kFollow = 6,         ///< promises more of the plan
  kRejoinSooner = 7,   ///< a shorter detour than the one that is driven
  kDetour = 8,
  kWeave = 9,          ///< on between what moves, off the plan
  kDetourLikely = 10,  ///< past the likely course of what moves
  kStop = 11,          ///< at once, as there is nothing to drive to
  kBrakeSoon = 12,
  kBrakeInTime = 13,
  kBrakeInTimeAtOnce = 14,
  kBrakeLikely = 15,
  kBrakeInTimeLikely = 16,
  kBrakeInTimeAtOnceLikely = 17,
  kSidestep = 18,
  kSidestepLikely = 19,
  kBrakeHard = 20,
  kEmergencyDetour = 21,
  kMostRoom = 22,    ///< keeps clear of all but the predictions, and as far as possible of these
  kLastResort = 23,  ///< nothing is certified
};

/// What generates the motions of a row.
enum class ManeuverKind {
  kFollow,
  kRejoinSooner,
  kDetour,
  kWeave,
  kStop,
  kBrakeSoon,
  kBrakeInTime,
  kBrakeInTimeAtOnce,
  kSidestep,
  kBrakeHard,
  kEmergencyDetour,
  kMostRoom,
  kLastResort,
};

/// One row of the ladder: the first motion of the maneuver that is certified is proposed.
struct Rung {
  Row row;
  ManeuverKind maneuver;
  RequirementName required;
  /// Is tried though another proposal waits for its answer, which it then replaces.
  bool replaces_pending;
};

/// The rows that a situation goes down.
const std::vector<Rung>& ladder_of(Situation situation);

/// In words: "detour on the likely course".
const char* to_text(Row row);

}  // namespace mocha
