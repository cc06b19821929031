#pragma once

namespace mocha {

/// What the goal executive is about.
enum class ExecutiveState {
  kIdle,    ///< no goal: the robot stays where it was told to stop
  kParked,  ///< all goals are reached: the robot stays unless it is in the way of a team-mate

  kPaused,  ///< somebody told it to stay where it is, whatever its goals, until it is to go on

  // On the way to the goal.
  kBraking,       ///< there is nothing to drive to until the robot rests, or is about to
  kPlanning,      ///< no plan yet: one is asked for as soon as possible
  kDriving,       ///< there is a plan; another replaces it only if it is much better
  kReplanning,    ///< there is a plan, and a request for another, better or not
  kBlocked,       ///< there is no plan: one is asked for again and again
  kGoalOccupied,  ///< the same, as the goal and all around it is occupied
  kUnreachable,   ///< the same, as no path leads to the goal on the map

  // On the way to a pull-over point, out of the way of a team-mate of higher rank.
  kPlanningPullOver,  ///< no plan yet, or a request for another
  kPullingOver,       ///< there is a plan
  kPullOverBlocked,   ///< there is no plan: one is asked for again and again
  kWaiting,  ///< has left the way to others; plans to the goal that keep out of it are driven
};

enum class ExecutiveEvent {
  // What the robot is told.
  kGoalGiven,      ///< instead of all goals before
  kGoalBehind,     ///< the same, and the robot has to brake before it can turn to it
  kStopped,        ///< all goals are dropped or given up
  kPaused,         ///< stays where it is, and keeps its goals
  kResumed,        ///< goes on after that
  kPlanRequested,  ///< the plan cannot be driven as it is
  kFollowed,       ///< the local replanner follows a motion of its own to the same place

  // What becomes of its motions.
  kBrakes,           ///< the motion in force ends as soon as the robot can rest
  kGoalReached,      ///< and another is to be reached next
  kAllReached,       ///< that was the last goal
  kPlanEnded,        ///< at another place than where the robot is to be
  kAtPullOverPoint,  ///< the robot stands at its pull-over point, with a goal still to be reached
  kStrayed,          ///< the robot stands somewhere else than where it waited

  // What the planner answers.
  kPlanFound,
  kPlanInTheWay,  ///< there is a plan, but it would get into the way of a higher rank
  kNoPlan,
  kGoalFoundOccupied,  ///< no plan to the goal, as there is no free place there
  kNoPathFound,        ///< no plan to the goal, as no path leads there on the map

  // What a look at the requests of team-mates came to.
  kPullOver,           ///< the robot is in the way of a higher rank, and there is a place to go to
  kPullOverHere,       ///< the same, and the place is where it comes to rest when it brakes
  kNowhereToPullOver,  ///< the same, but there is no such place
  kWayIsClear,         ///< no way has to be kept free any more
  kNoNeedToPullOver,   ///< the same for a robot without a goal, or it stands at its point
};

/// The transition table. An event without an entry changes nothing.
ExecutiveState next_state(ExecutiveState state, ExecutiveEvent event);

/// Whether the table has an entry: an event without one is not heeded.
bool heeds(ExecutiveState state, ExecutiveEvent event);

/// Whether the robot leaves its place to make room for others.
bool makes_room(ExecutiveState state);
/// Whether there is a plan that is being driven, to the goal or to the pull-over point.
bool drives_plan(ExecutiveState state);

/// For people: "driving", "waiting for others to pass" ...
const char* to_text(ExecutiveState state);

}  // namespace mocha
