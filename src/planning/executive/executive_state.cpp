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

constexpr Everywhere kWhereItTakesPart[] = {
    {E::kTurn, S::kPlanning},
    {E::kNotItsTurn, S::kWaiting},
    {E::kPassed, S::kReplanning},
    {E::kPassedToTheEnd, S::kParked},
};

struct Transition {
  S from;
  E event;
  S to;
};

constexpr Transition kTransitions[] = {
    // Whatever happens, it stays there until it is resumed.
    {S::kPaused, E::kGoalGiven, S::kPaused},
    {S::kPaused, E::kGoalBehind, S::kPaused},
    {S::kPaused, E::kStopped, S::kPaused},
    {S::kPaused, E::kResumed, S::kBraking},

    {S::kBraking, E::kBrakes, S::kPlanning},

    {S::kPlanning, E::kPlanFound, S::kDriving},
    {S::kPlanning, E::kNoPlan, S::kBlocked},
    {S::kPlanning, E::kGoalFoundOccupied, S::kGoalOccupied},
    {S::kPlanning, E::kNoPathFound, S::kUnreachable},

    {S::kDriving, E::kPlanRequested, S::kReplanning},
    {S::kDriving, E::kFollowed, S::kDriving},
    {S::kDriving, E::kPlanEnded, S::kBlocked},
    {S::kDriving, E::kPlanFound, S::kDriving},

    // Without another plan, the one at hand is driven as far as it can be.
    {S::kReplanning, E::kFollowed, S::kReplanning},
    {S::kReplanning, E::kPlanEnded, S::kBlocked},
    {S::kReplanning, E::kPlanFound, S::kDriving},
    {S::kReplanning, E::kNoPlan, S::kDriving},
    {S::kReplanning, E::kGoalFoundOccupied, S::kDriving},
    {S::kReplanning, E::kNoPathFound, S::kDriving},

    {S::kBlocked, E::kPlanRequested, S::kPlanning},
    {S::kBlocked, E::kFollowed, S::kDriving},
    {S::kBlocked, E::kPlanFound, S::kDriving},
    {S::kBlocked, E::kGoalFoundOccupied, S::kGoalOccupied},
    {S::kBlocked, E::kNoPathFound, S::kUnreachable},

    {S::kGoalOccupied, E::kFollowed, S::kDriving},
    {S::kGoalOccupied, E::kPlanFound, S::kDriving},
    {S::kGoalOccupied, E::kNoPlan, S::kBlocked},
    {S::kGoalOccupied, E::kNoPathFound, S::kUnreachable},

    {S::kUnreachable, E::kFollowed, S::kDriving},
    {S::kUnreachable, E::kPlanFound, S::kDriving},
    {S::kUnreachable, E::kNoPlan, S::kBlocked},
    {S::kUnreachable, E::kGoalFoundOccupied, S::kGoalOccupied},
};

std::optional<S> entry(S state, E event) {
  for (const Transition& transition : kTransitions) {
    if (transition.from == state && transition.event == event) return transition.to;
  }
  for (const Everywhere& transition : kFromEverywhere) {
    if (transition.event == event) return transition.to;
  }
  for (const Everywhere& transition : kWhereItTakesPart) {
    if (transition.event == event && takes_part(state)) return transition.to;
  }
  return std::nullopt;
}

}  // namespace

ExecutiveState next_state(ExecutiveState state, ExecutiveEvent event) {
  return entry(state, event).value_or(state);
}

bool heeds(ExecutiveState state, ExecutiveEvent event) { return entry(state, event).has_value(); }

bool takes_part(ExecutiveState state) { return state != S::kIdle && state != S::kPaused; }

bool drives_plan(ExecutiveState state) { return state == S::kDriving || state == S::kReplanning; }

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
    case S::kWaiting:
      return "waiting for its turn to pass";
  }
  return "unknown";
}

}  // namespace mocha
