#pragma once

namespace mocha {

/// What the goal executive is about.
enum class ExecutiveState {
  kIdle,    ///< no goal: the robot stays where it was told to stop
  kParked,  ///< all goals are reached: the robot stays unless an order asks it to make room

  kPaused,  ///< somebody told it to stay where it is, whatever its goals, until it is to go on

  // On the way to the goal, or to where an order of passing leads next.
  kBraking,       ///< there is nothing to drive to until the robot rests, or is about to
  kPlanning,      ///< no plan yet: one is asked for as soon as possible
  kDriving,       ///< there is a plan; another replaces it only if it is much better
  kReplanning,    ///< there is a plan, and a request for another, better or not
  kBlocked,       ///< there is no plan: one is asked for again and again
  kGoalOccupied,  ///< the same, as the goal and all around it is occupied
  kUnreachable,   ///< the same, as no path leads to the goal on the map

  kWaiting,  ///< for its turn, in an order in which it and others pass each other
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
  kBrakes,       ///< the motion in force ends as soon as the robot can rest
  kGoalReached,  ///< and another is to be reached next
  kAllReached,   ///< that was the last goal
  kPlanEnded,    ///< at another place than where the robot is to be

  // What the planner answers.
  kPlanFound,
  kNoPlan,
  kGoalFoundOccupied,  ///< no plan to the goal, as there is no free place there
  kNoPathFound,        ///< no plan to the goal, as no path leads there on the map

  // What the order of passing asks.
  kTurn,            ///< the robot may make some of its moves
  kNotItsTurn,      ///< it has to wait for others
  kPassed,          ///< it is through, or the order is void
  kPassedToTheEnd,  ///< the same for a robot without a goal
};

/// The transition table. An event without an entry changes nothing.
ExecutiveState next_state(ExecutiveState state, ExecutiveEvent event);

/// Whether the table has an entry: an event without one is not heeded.
bool heeds(ExecutiveState state, ExecutiveEvent event);

/// Whether the robot keeps to orders of passing.
bool takes_part(ExecutiveState state);
/// Whether there is a plan that is being driven.
bool drives_plan(ExecutiveState state);

/// For people: "driving", "waiting for others to pass" ...
const char* to_text(ExecutiveState state);

}  // namespace mocha
