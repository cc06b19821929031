#include "planning/executive/executive_state.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace mocha {
namespace {

using S = ExecutiveState;
using E = ExecutiveEvent;
using Row = std::map<E, S>;

constexpr S kStates[] = {S::kIdle,         S::kParked,      S::kPaused,     S::kBraking,
                         S::kPlanning,     S::kDriving,     S::kReplanning, S::kBlocked,
                         S::kGoalOccupied, S::kUnreachable, S::kWaiting};
constexpr E kEvents[] = {E::kGoalGiven,     E::kGoalBehind,
                         E::kStopped,       E::kPaused,
                         E::kResumed,       E::kPlanRequested,
                         E::kFollowed,      E::kBrakes,
                         E::kGoalReached,   E::kAllReached,
                         E::kPlanEnded,     E::kPlanFound,
                         E::kNoPlan,        E::kGoalFoundOccupied,
                         E::kNoPathFound,   E::kTurn,
                         E::kNotItsTurn,    E::kPassed,
                         E::kPassedToTheEnd};

/// What each event leads to in each state; an event that is not named is not heeded.
std::map<S, Row> table() {
  const Row without_plan = {{E::kPlanFound, S::kDriving},
                            {E::kNoPlan, S::kBlocked},
                            {E::kGoalFoundOccupied, S::kGoalOccupied},
                            {E::kNoPathFound, S::kUnreachable}};
  std::map<S, Row> rows;
  rows[S::kIdle] = {};
  rows[S::kParked] = {};
  rows[S::kPaused] = {{E::kGoalGiven, S::kPaused},
                      {E::kGoalBehind, S::kPaused},
                      {E::kStopped, S::kPaused},
                      {E::kResumed, S::kBraking}};
  rows[S::kBraking] = {{E::kBrakes, S::kPlanning}};
  rows[S::kPlanning] = without_plan;
  rows[S::kDriving] = {{E::kPlanRequested, S::kReplanning},
                       {E::kFollowed, S::kDriving},
                       {E::kPlanEnded, S::kBlocked},
                       {E::kPlanFound, S::kDriving}};
  rows[S::kReplanning] = {
      {E::kFollowed, S::kReplanning}, {E::kPlanEnded, S::kBlocked},
      {E::kPlanFound, S::kDriving},   {E::kNoPlan, S::kDriving},
      {E::kNoPathFound, S::kDriving}, {E::kGoalFoundOccupied, S::kDriving},
  };
  rows[S::kBlocked] = without_plan;
  rows[S::kBlocked].erase(E::kNoPlan);
  rows[S::kBlocked].insert({{E::kPlanRequested, S::kPlanning}, {E::kFollowed, S::kDriving}});
  rows[S::kGoalOccupied] = without_plan;
  rows[S::kGoalOccupied].erase(E::kGoalFoundOccupied);
  rows[S::kGoalOccupied][E::kFollowed] = S::kDriving;
  rows[S::kUnreachable] = without_plan;
  rows[S::kUnreachable].erase(E::kNoPathFound);
  rows[S::kUnreachable][E::kFollowed] = S::kDriving;
  rows[S::kWaiting] = {};
  for (const S state : kStates) {
    Row& row = rows[state];
    row.insert({{E::kGoalGiven, S::kPlanning},
                {E::kGoalBehind, S::kBraking},
                {E::kStopped, S::kIdle},
                {E::kPaused, S::kPaused},
                {E::kGoalReached, S::kPlanning},
                {E::kAllReached, S::kParked}});
    if (state == S::kIdle || state == S::kPaused) continue;
    row.insert({{E::kTurn, S::kPlanning},
                {E::kNotItsTurn, S::kWaiting},
                {E::kPassed, S::kReplanning},
                {E::kPassedToTheEnd, S::kParked}});
  }
  return rows;
}

TEST(ExecutiveState, FollowsTheTable) {
  const std::map<S, Row> expected = table();
  for (const S state : kStates) {
    for (std::size_t i = 0; i < std::size(kEvents); ++i) {
      const Row& row = expected.at(state);
      const auto entry = row.find(kEvents[i]);
      const bool named = entry != row.end();
      EXPECT_EQ(heeds(state, kEvents[i]), named) << to_text(state) << ", event " << i;
      EXPECT_EQ(next_state(state, kEvents[i]), named ? entry->second : state)
          << to_text(state) << ", event " << i;
    }
  }
}

TEST(ExecutiveState, EveryStateIsReachedFromEveryOther) {
  for (const S start : kStates) {
    std::set<S> reached = {start};
    for (std::vector<S> open = {start}; !open.empty();) {
      const S state = open.back();
      open.pop_back();
      for (const E event : kEvents) {
        const S next = next_state(state, event);
        if (reached.insert(next).second) open.push_back(next);
      }
    }
    EXPECT_EQ(reached.size(), std::size(kStates)) << to_text(start);
  }
}

TEST(ExecutiveState, OnlyAGoalOrAPauseEndsIdleness) {
  for (const E event : kEvents) {
    const bool told = event == E::kGoalGiven || event == E::kGoalBehind || event == E::kPaused;
    const bool reached = event == E::kGoalReached || event == E::kAllReached;
    EXPECT_EQ(next_state(S::kIdle, event) != S::kIdle, told || reached);
  }
}

TEST(ExecutiveState, AStopAndANewGoalGoBeforeEverythingButAPause) {
  for (const S state : kStates) {
    const bool paused = state == S::kPaused;
    EXPECT_EQ(next_state(state, E::kStopped), paused ? S::kPaused : S::kIdle);
    EXPECT_EQ(next_state(state, E::kGoalGiven), paused ? S::kPaused : S::kPlanning);
    EXPECT_EQ(next_state(state, E::kGoalBehind), paused ? S::kPaused : S::kBraking);
    EXPECT_EQ(next_state(state, E::kPaused), S::kPaused);
  }
}

/// A robot without a goal gets none by making room.
TEST(ExecutiveState, ParkedRobotsMakeRoomAndAreParkedAgain) {
  EXPECT_TRUE(takes_part(S::kParked));
  const S there = next_state(S::kParked, E::kTurn);
  for (const E event : {E::kPlanFound, E::kNoPlan, E::kNotItsTurn}) {
    const S state = next_state(there, event);
    EXPECT_TRUE(takes_part(state)) << to_text(state);
    EXPECT_EQ(next_state(state, E::kPassedToTheEnd), S::kParked);
  }
}

TEST(ExecutiveState, AllButTheIdleAndThePausedTakePart) {
  for (const S state : kStates)
    EXPECT_EQ(takes_part(state), state != S::kIdle && state != S::kPaused) << to_text(state);
}

TEST(ExecutiveState, NothingIsDrivenByWhoWaits) {
  for (const S state : kStates)
    EXPECT_EQ(drives_plan(state), state == S::kDriving || state == S::kReplanning)
        << to_text(state);
}

TEST(ExecutiveState, ANameForEach) {
  std::set<std::string> names;
  for (const S state : kStates) names.insert(to_text(state));
  EXPECT_EQ(names.size(), std::size(kStates));
  EXPECT_EQ(names.count("unknown"), 0u);
}

}  // namespace
}  // namespace mocha
