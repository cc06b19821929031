#include "planning/executive/executive_state.h"

#include <optional>

namespace mocha {
namespace {

using S = ExecutiveState;
using E = ExecutiveEvent;

struct Everywhere {
  E event;
  S to;
};

// But for the state in which the table has another entry.
constexpr Everywhere kFromEverywhere[] = {
    {E::kGoalGiven, S::kPlanning}, {E::kGoalBehind, S::kBraking},   {E::kStopped, S::kIdle},
    {E::kPaused, S::kPaused},      {E::kGoalReached, S::kPlanning}, {E::kAllReached, S::kParked},
};

struct Transition {
  S from;
  E event;
  S to;
};

constexpr Transition kTransitions[] = {
    {S::kParked, E::kPullOver, S::kPlanningPullOver},
    {S::kParked, E::kPullOverHere, S::kPullingOver},

    // Whatever happens, it stays there until it is resumed.
    {S::kPaused, E::kGoalGiven, S::kPaused},
    {S::kPaused, E::kGoalBehind, S::kPaused},
    {S::kPaused, E::kStopped, S::kPaused},
    {S::kPaused, E::kResumed, S::kBraking},

    {S::kBraking, E::kBrakes, S::kPlanning},
    {S::kBraking, E::kPullOver, S::kPlanningPullOver},
    {S::kBraking, E::kPullOverHere, S::kPullingOver},
    {S::kBraking, E::kNowhereToPullOver, S::kBraking},

    {S::kPlanning, E::kPlanFound, S::kDriving},
    {S::kPlanning, E::kPlanInTheWay, S::kWaiting},
    {S::kPlanning, E::kNoPlan, S::kBlocked},
    {S::kPlanning, E::kGoalFoundOccupied, S::kGoalOccupied},
    {S::kPlanning, E::kNoPathFound, S::kUnreachable},
    {S::kPlanning, E::kPullOver, S::kPlanningPullOver},
    {S::kPlanning, E::kPullOverHere, S::kPullingOver},
    {S::kPlanning, E::kNowhereToPullOver, S::kPlanning},

    {S::kDriving, E::kPlanRequested, S::kReplanning},
    {S::kDriving, E::kFollowed, S::kDriving},
    {S::kDriving, E::kPlanEnded, S::kBlocked},
    {S::kDriving, E::kPlanFound, S::kDriving},
    {S::kDriving, E::kPullOver, S::kPlanningPullOver},
    {S::kDriving, E::kPullOverHere, S::kPullingOver},
    {S::kDriving, E::kNowhereToPullOver, S::kPlanning},

    // Without another plan, the one at hand is driven as far as it can be.
    {S::kReplanning, E::kFollowed, S::kReplanning},
    {S::kReplanning, E::kPlanEnded, S::kBlocked},
    {S::kReplanning, E::kPlanFound, S::kDriving},
    {S::kReplanning, E::kPlanInTheWay, S::kDriving},
    {S::kReplanning, E::kNoPlan, S::kDriving},
    {S::kReplanning, E::kGoalFoundOccupied, S::kDriving},
    {S::kReplanning, E::kNoPathFound, S::kDriving},
    {S::kReplanning, E::kPullOver, S::kPlanningPullOver},
    {S::kReplanning, E::kPullOverHere, S::kPullingOver},
    {S::kReplanning, E::kNowhereToPullOver, S::kPlanning},

    {S::kBlocked, E::kPlanRequested, S::kPlanning},
    {S::kBlocked, E::kFollowed, S::kDriving},
    {S::kBlocked, E::kPlanFound, S::kDriving},
    {S::kBlocked, E::kPlanInTheWay, S::kWaiting},
    {S::kBlocked, E::kGoalFoundOccupied, S::kGoalOccupied},
    {S::kBlocked, E::kNoPathFound, S::kUnreachable},
    {S::kBlocked, E::kPullOver, S::kPlanningPullOver},
    {S::kBlocked, E::kPullOverHere, S::kPullingOver},
    {S::kBlocked, E::kNowhereToPullOver, S::kPlanning},

    {S::kGoalOccupied, E::kFollowed, S::kDriving},
    {S::kGoalOccupied, E::kPlanFound, S::kDriving},
    {S::kGoalOccupied, E::kPlanInTheWay, S::kWaiting},
    {S::kGoalOccupied, E::kNoPlan, S::kBlocked},
    {S::kGoalOccupied, E::kNoPathFound, S::kUnreachable},
    {S::kGoalOccupied, E::kPullOver, S::kPlanningPullOver},
    {S::kGoalOccupied, E::kPullOverHere, S::kPullingOver},
    {S::kGoalOccupied, E::kNowhereToPullOver, S::kPlanning},

    {S::kUnreachable, E::kFollowed, S::kDriving},
    {S::kUnreachable, E::kPlanFound, S::kDriving},
    {S::kUnreachable, E::kPlanInTheWay, S::kWaiting},
    {S::kUnreachable, E::kNoPlan, S::kBlocked},
    {S::kUnreachable, E::kGoalFoundOccupied, S::kGoalOccupied},
    {S::kUnreachable, E::kPullOver, S::kPlanningPullOver},
    {S::kUnreachable, E::kPullOverHere, S::kPullingOver},
    {S::kUnreachable, E::kNowhereToPullOver, S::kPlanning},

    {S::kPlanningPullOver, E::kAtPullOverPoint, S::kWaiting},
    {S::kPlanningPullOver, E::kPlanFound, S::kPullingOver},
    {S::kPlanningPullOver, E::kNoPlan, S::kPullOverBlocked},
    {S::kPlanningPullOver, E::kPullOver, S::kPlanningPullOver},
    {S::kPlanningPullOver, E::kPullOverHere, S::kPullingOver},
    {S::kPlanningPullOver, E::kNowhereToPullOver, S::kPlanning},
    {S::kPlanningPullOver, E::kWayIsClear, S::kPlanning},
    {S::kPlanningPullOver, E::kNoNeedToPullOver, S::kParked},

    {S::kPullingOver, E::kPlanRequested, S::kPlanningPullOver},
    {S::kPullingOver, E::kFollowed, S::kPullingOver},
    {S::kPullingOver, E::kPlanEnded, S::kPlanningPullOver},
    {S::kPullingOver, E::kAtPullOverPoint, S::kWaiting},
    {S::kPullingOver, E::kPullOver, S::kPlanningPullOver},
    {S::kPullingOver, E::kPullOverHere, S::kPullingOver},
    {S::kPullingOver, E::kNowhereToPullOver, S::kPlanning},
    {S::kPullingOver, E::kWayIsClear, S::kPlanning},
    {S::kPullingOver, E::kNoNeedToPullOver, S::kParked},

    {S::kPullOverBlocked, E::kPlanRequested, S::kPlanningPullOver},
    {S::kPullOverBlocked, E::kAtPullOverPoint, S::kWaiting},
    {S::kPullOverBlocked, E::kPlanFound, S::kPullingOver},
    {S::kPullOverBlocked, E::kPullOver, S::kPlanningPullOver},
    {S::kPullOverBlocked, E::kPullOverHere, S::kPullingOver},
    {S::kPullOverBlocked, E::kNowhereToPullOver, S::kPlanning},
    {S::kPullOverBlocked, E::kWayIsClear, S::kPlanning},
    {S::kPullOverBlocked, E::kNoNeedToPullOver, S::kParked},

    {S::kWaiting, E::kStrayed, S::kPlanningPullOver},
    {S::kWaiting, E::kPlanFound, S::kDriving},
    {S::kWaiting, E::kPullOver, S::kPlanningPullOver},
    {S::kWaiting, E::kPullOverHere, S::kPullingOver},
    {S::kWaiting, E::kNowhereToPullOver, S::kPlanning},
    {S::kWaiting, E::kWayIsClear, S::kPlanning},
};

std::optional<S> entry(S state, E event) {
  for (const Transition& transition : kTransitions) {
    if (transition.from == state && transition.event == event) return transition.to;
  }
  for (const Everywhere& transition : kFromEverywhere) {
    if (transition.event == event) return transition.to;
  }
  return std::nullopt;
}

}  // namespace

ExecutiveState next_state(ExecutiveState state, ExecutiveEvent event) {
  return entry(state, event).value_or(state);
}

bool heeds(ExecutiveState state, ExecutiveEvent event) { return entry(state, event).has_value(); }

bool makes_room(ExecutiveState state) {
  return state == S::kPlanningPullOver || state == S::kPullingOver || state == S::kPullOverBlocked;
}

bool drives_plan(ExecutiveState state) {
  return state == S::kDriving || state == S::kReplanning || state == S::kPullingOver;
}

const char* to_text(ExecutiveState state) {
  switch (state) {
    case S::kIdle:
      return "no goal";
    case S::kParked:
      return "parked at its goal";
    case S::kPaused:
      return "paused";
    case S::kBraking:
      return "braking, to plan anew";
    case S::kPlanning:
      return "planning";
    case S::kDriving:
      return "driving";
    case S::kReplanning:
      return "driving, planning anew";
    case S::kBlocked:
      return "without a plan";
    case S::kGoalOccupied:
      return "the goal is occupied";
    case S::kUnreachable:
      return "the goal cannot be reached";
    case S::kPlanningPullOver:
      return "planning to make room";
    case S::kPullingOver:
      return "making room";
    case S::kPullOverBlocked:
      return "cannot get out of the way";
    case S::kWaiting:
      return "waiting for others to pass";
  }
  return "unknown";
}

}  // namespace mocha
