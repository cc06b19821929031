#include "planning/replanner/ladder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace mocha {
namespace {

constexpr Situation kSituations[] = {
    Situation::kHolds,   Situation::kPlanMeets, Situation::kInTurn, Situation::kThreatened,
    Situation::kBlocked, Situation::kInTheWay,  Situation::kNoGoal};
constexpr Situation kInDanger[] = {Situation::kThreatened, Situation::kBlocked,
                                   Situation::kInTheWay};
constexpr int kRows = static_cast<int>(Row::kLastResort) + 1;

std::vector<Row> rows_of(Situation situation) {
  std::vector<Row> rows;
  for (const Rung& rung : ladder_of(situation)) rows.push_back(rung.row);
  return rows;
}

/// The lesser, the later. The margins of a renewal are those of what is in force, limits those of
/// an emergency.
int rank(RequirementName name) {
  switch (name) {
    case RequirementName::kPromise:
      return 0;
    case RequirementName::kPromiseLikely:
      return 1;
    case RequirementName::kEmergency:
      return 2;
    case RequirementName::kRenewal:
      return 3;
    case RequirementName::kEscape:
      return 4;
    case RequirementName::kNone:
      return 5;
    default:
      ADD_FAILURE() << to_text(name) << " is none of what becomes a promise";
      return 0;
  }
}

TEST(Ladder, RowsAreInTheirOrder) {
  using R = Row;
  const std::map<Situation, std::vector<Row>> expected = {
      {Situation::kHolds, {R::kRejoinSooner, R::kFollow, R::kDetour, R::kDetourLikely}},
      {Situation::kPlanMeets, {R::kDetour, R::kWeave, R::kDetourLikely, R::kFollow}},
      {Situation::kInTurn, {R::kFollow}},
      {Situation::kThreatened,
       {R::kFollow, R::kDetour, R::kWeave, R::kDetourLikely, R::kBrakeSoon, R::kBrakeInTime,
        R::kBrakeInTimeAtOnce, R::kBrakeLikely, R::kBrakeInTimeLikely, R::kBrakeInTimeAtOnceLikely,
        R::kSidestep, R::kSidestepLikely, R::kBrakeHard, R::kEmergencyDetour, R::kMostRoom,
        R::kLastResort}},
      {Situation::kBlocked,
       {R::kFollow, R::kDetour, R::kDetourLikely, R::kBrakeInTime, R::kBrakeInTimeAtOnce,
        R::kBrakeInTimeLikely, R::kBrakeInTimeAtOnceLikely, R::kSidestep, R::kSidestepLikely,
        R::kBrakeHard, R::kEmergencyDetour, R::kLastResort}},
      {Situation::kInTheWay,
       {R::kFollow, R::kDetour, R::kWeave, R::kDetourLikely, R::kSidestep, R::kSidestepLikely,
        R::kEmergencyDetour, R::kMostRoom, R::kLastResort}},
      {Situation::kNoGoal, {R::kStop}}};
  for (const Situation situation : kSituations)
    EXPECT_EQ(rows_of(situation), expected.at(situation)) << static_cast<int>(situation);
}

TEST(Ladder, InDangerItOnlyGoesDown) {
  for (const Situation situation : kInDanger) {
    const std::vector<Row> rows = rows_of(situation);
    EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end())) << static_cast<int>(situation);
    EXPECT_EQ(std::adjacent_find(rows.begin(), rows.end()), rows.end());
  }
}

TEST(Ladder, EachRowThatProposesStandsInOneAtLeast) {
  std::set<Row> found;
  for (const Situation situation : kSituations) {
    for (const Row row : rows_of(situation)) found.insert(row);
  }
  for (int row = static_cast<int>(Row::kFollow); row < kRows; ++row)
    EXPECT_EQ(found.count(static_cast<Row>(row)), 1u) << to_text(static_cast<Row>(row));
  EXPECT_EQ(*found.begin(), Row::kFollow) << "the rows before are no rungs";
}

TEST(Ladder, InDangerTheLastRungIsTheLastResort) {
  for (const Situation situation : kSituations) {
    const std::vector<Rung>& ladder = ladder_of(situation);
    const bool in_danger = std::count(std::begin(kInDanger), std::end(kInDanger), situation) > 0;
    EXPECT_EQ(ladder.back().row == Row::kLastResort, in_danger);
    for (const Rung& rung : ladder) {
      EXPECT_EQ(rung.row == Row::kLastResort, rung.required == RequirementName::kNone)
          << to_text(rung.row) << ": only the last resort is not certified";
    }
  }
}

/// What was tried and not certified is not tried again with as much asked of it, and of the other
/// maneuvers none comes after a lesser one of its kind.
TEST(Ladder, EachManeuverIsAskedForLessAndLess) {
  for (const Situation situation : kSituations) {
    std::map<ManeuverKind, int> asked;
    for (const Rung& rung : ladder_of(situation)) {
      const int before = asked.count(rung.maneuver) > 0 ? asked.at(rung.maneuver) : -1;
      EXPECT_GT(rank(rung.required), before) << to_text(rung.row);
      asked[rung.maneuver] = rank(rung.required);
    }
  }
}

TEST(Ladder, WhatHasTheLimitsOfAnEmergencyComesAfterWhatHasThoseOfDriving) {
  for (const Situation situation : kSituations) {
    bool emergencies = false;
    for (const Rung& rung : ladder_of(situation)) {
      const bool emergency = rank(rung.required) >= rank(RequirementName::kEmergency);
      EXPECT_TRUE(emergency || !emergencies) << to_text(rung.row);
      emergencies = emergency;
    }
  }
}

TEST(Ladder, OnlyWhatIsDoneInDangerOrWithoutAGoalReplacesAPendingProposal) {
  for (const Situation situation : kSituations) {
    for (const Rung& rung : ladder_of(situation))
      EXPECT_EQ(rung.replaces_pending, rung.row >= Row::kStop) << to_text(rung.row);
  }
}

TEST(Ladder, RowsHaveTheirOwnWords) {
  std::set<std::string> words;
  for (int row = 0; row < kRows; ++row) words.insert(to_text(static_cast<Row>(row)));
  EXPECT_EQ(words.size(), static_cast<std::size_t>(kRows));
  EXPECT_EQ(words.count("unknown"), 0u);
}

}  // namespace
}  // namespace mocha
