#include "ros_bridge/messages/status_conversions.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "planning/worlds.h"

namespace mocha {
namespace {

const ros::Time kStamp(1.7e9);

Violation violation() {
  Violation violation;
  violation.term = ViolatedTerm::kSeparation;
  violation.time_s = 1.7e9 + 2.5;
  violation.place = {1.5, -2.0};
  violation.value = 0.4;
  violation.limit = 0.8;
  violation.peer = "ugv2";
  return violation;
}

TEST(StatusConversions, SayWhatWhereWhenAndByHowMuch) {
  const auto status =
      to_message(PlanReason::kPeerConflict, violation(), "too close", "map", kStamp);
  EXPECT_EQ(status.header.frame_id, "map");
  EXPECT_EQ(status.header.stamp, kStamp);
  EXPECT_EQ(status.reason, mocha_ugv::PlannerStatus::PEER_CONFLICT);
  EXPECT_EQ(status.violated, mocha_ugv::PlannerStatus::SEPARATION);
  EXPECT_EQ(status.message, "too close");
  EXPECT_NEAR((status.at - kStamp).toSec(), 2.5, 1e-6);
  EXPECT_EQ(status.place.x, 1.5);
  EXPECT_EQ(status.place.y, -2.0);
  EXPECT_EQ(status.value, 0.4);
  EXPECT_EQ(status.limit, 0.8);
  EXPECT_EQ(status.peer, "ugv2");
}

TEST(StatusConversions, ComeBackAsTheyWere) {
  auto status = to_message(PlanReason::kPeerConflict, violation(), "too close", "map", kStamp);
  const auto report = from_message(status);
  EXPECT_EQ(report.reason, PlanReason::kPeerConflict);
  EXPECT_EQ(report.message, "too close");
  EXPECT_EQ(describe(report.violation), describe(violation()));
  status.reason = mocha_ugv::PlannerStatus::PAUSED + 1;
  EXPECT_THROW(from_message(status), std::invalid_argument);
  status.reason = mocha_ugv::PlannerStatus::PAUSED;
  status.violated = mocha_ugv::PlannerStatus::ZONE_SPEED + 1;
  EXPECT_THROW(from_message(status), std::invalid_argument);
}

TEST(StatusConversions, WithoutAViolationItsFieldsAreEmpty) {
  const auto status = to_message(PlanReason::kNoGoal, {}, "", "map", kStamp);
  EXPECT_EQ(status.violated, mocha_ugv::PlannerStatus::NOTHING);
  EXPECT_TRUE(status.at.isZero());
}

TEST(StatusConversions, EveryReasonHasItsOwnWordsAndNumber) {
  using Status = mocha_ugv::PlannerStatus;
  const std::pair<PlanReason, int> numbers[] = {
      {PlanReason::kSolved, Status::SOLVED},
      {PlanReason::kNoGoal, Status::NO_GOAL},
      {PlanReason::kNoMap, Status::NO_MAP},
      {PlanReason::kNoPose, Status::NO_POSE},
      {PlanReason::kInvalidInput, Status::INVALID_INPUT},
      {PlanReason::kStartOccupied, Status::START_OCCUPIED},
      {PlanReason::kGoalOccupied, Status::GOAL_OCCUPIED},
      {PlanReason::kNoPath, Status::NO_PATH},
      {PlanReason::kNotCertified, Status::NOT_CERTIFIED},
      {PlanReason::kBudgetExhausted, Status::BUDGET_EXHAUSTED},
      {PlanReason::kPeerConflict, Status::PEER_CONFLICT},
      {PlanReason::kBraking, Status::BRAKING},
      {PlanReason::kCannotWin, Status::CANNOT_WIN},
      {PlanReason::kEmergencyStop, Status::EMERGENCY_STOP},
      {PlanReason::kPaused, Status::PAUSED}};
  std::set<std::string> words;
  for (const auto& [reason, number] : numbers) {
    EXPECT_EQ(to_message(reason, {}, "", "map", kStamp).reason, number);
    words.insert(to_text(reason));
  }
  EXPECT_EQ(words.size(), std::size(numbers));
  EXPECT_EQ(words.count("unknown"), 0u);
}

TEST(StatusConversions, EveryRowHasItsOwnNumberAndWords) {
  using Status = mocha_ugv::ReplannerStatus;
  const std::pair<Row, int> numbers[] = {
      {Row::kKeep, Status::KEEP},
      {Row::kWait, Status::WAIT},
      {Row::kStand, Status::STAND},
      {Row::kStopHere, Status::STOP_HERE},
      {Row::kStopBlind, Status::STOP_BLIND},
      {Row::kEmergencyStop, Status::EMERGENCY_STOP},
      {Row::kFollow, Status::FOLLOW},
      {Row::kRejoinSooner, Status::REJOIN_SOONER},
      {Row::kDetour, Status::DETOUR},
      {Row::kWeave, Status::WEAVE},
      {Row::kDetourLikely, Status::DETOUR_LIKELY},
      {Row::kStop, Status::STOP},
      {Row::kBrakeSoon, Status::BRAKE_SOON},
      {Row::kBrakeInTime, Status::BRAKE_IN_TIME},
      {Row::kBrakeInTimeAtOnce, Status::BRAKE_IN_TIME_AT_ONCE},
      {Row::kBrakeLikely, Status::BRAKE_LIKELY},
      {Row::kBrakeInTimeLikely, Status::BRAKE_IN_TIME_LIKELY},
      {Row::kBrakeInTimeAtOnceLikely, Status::BRAKE_IN_TIME_AT_ONCE_LIKELY},
      {Row::kSidestep, Status::SIDESTEP},
      {Row::kSidestepLikely, Status::SIDESTEP_LIKELY},
      {Row::kBrakeHard, Status::BRAKE_HARD},
      {Row::kEmergencyDetour, Status::EMERGENCY_DETOUR},
      {Row::kMostRoom, Status::MOST_ROOM},
      {Row::kLastResort, Status::LAST_RESORT}};
  const auto why = to_message(PlanReason::kBraking, violation(), "brakes", "map", kStamp);
  std::set<std::string> words;
  for (const auto& [row, number] : numbers) {
    EXPECT_EQ(static_cast<int>(row), number);
    const auto status = to_message(row, why);
    EXPECT_EQ(status.row, number);
    EXPECT_EQ(status.doing, to_text(row));
    EXPECT_EQ(status.header.stamp, kStamp);
    EXPECT_EQ(status.header.frame_id, "map");
    EXPECT_EQ(status.status.reason, why.reason);
    EXPECT_EQ(status.status.message, "brakes");
    words.insert(status.doing);
  }
  EXPECT_EQ(words.size(), std::size(numbers));
  EXPECT_EQ(words.size(), static_cast<std::size_t>(Row::kLastResort) + 1);
}

TEST(StatusConversions, EveryFallbackHasItsOwnNumberAndWords) {
  using Message = mocha_ugv::Fallback;
  const std::pair<FallbackKind, int> numbers[] = {
      {FallbackKind::kLatticePath, Message::LATTICE_PATH},
      {FallbackKind::kCoincidentPoints, Message::COINCIDENT_POINTS},
      {FallbackKind::kSharpBend, Message::SHARP_BEND},
      {FallbackKind::kCamouflageGivenUp, Message::CAMOUFLAGE_GIVEN_UP},
      {FallbackKind::kSlowedDown, Message::SLOWED_DOWN}};
  ASSERT_EQ(std::size(numbers), kFallbackKinds.size());
  for (const auto& [kind, number] : numbers) {
    const Message message = to_message(kind, {3, {1.5, -2.0}, true});
    EXPECT_EQ(message.kind, number);
    EXPECT_EQ(message.message, describe(Fallback{kind, {1.5, -2.0}}));
    EXPECT_EQ(message.place.x, 1.5);
    EXPECT_EQ(message.place.y, -2.0);
    EXPECT_EQ(message.plans, 3u);
    EXPECT_TRUE(message.in_last_plan);
  }
}

TEST(StatusConversions, TheEffortHasAllThatPlansFellBackOn) {
  PlanningRecord record;
  PlanningEffort effort;
  effort.took_s = 0.5;
  effort.parameterisation = Parameterisation::kWaypoints;
  effort.fallbacks = {{FallbackKind::kCamouflageGivenUp, {1.0, 2.0}}};
  record.add(effort);
  effort.fallbacks = {{FallbackKind::kSharpBend, {3.0, 4.0}}};
  record.add(effort);
  const auto message = to_message(record);
  EXPECT_EQ(message.time, 0.5);
  EXPECT_EQ(message.plans, 2u);
  EXPECT_EQ(message.parameterisation, mocha_ugv::PlanningEffort::WAYPOINTS);
  ASSERT_EQ(message.fallbacks.size(), 2u);
  EXPECT_EQ(message.fallbacks[0].kind, mocha_ugv::Fallback::SHARP_BEND);
  EXPECT_TRUE(message.fallbacks[0].in_last_plan);
  EXPECT_EQ(message.fallbacks[0].plans, 1u);
  EXPECT_EQ(message.fallbacks[1].kind, mocha_ugv::Fallback::CAMOUFLAGE_GIVEN_UP);
  EXPECT_FALSE(message.fallbacks[1].in_last_plan);
}

TEST(StatusConversions, AViolationAtNoTimeOfRosIsNoProblem) {
  Violation strange = violation();
  for (const double time_s : {-1.0, 1e300, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()}) {
    strange.time_s = time_s;
    EXPECT_NO_THROW(to_message(PlanReason::kBraking, strange, "", "map", kStamp)) << time_s;
  }
}

TEST(StatusConversions, CandidatesCarryCostsAndPath) {
  PlanCandidate candidate;
  candidate.signature = {1, -1};
  candidate.reason = PlanReason::kSolved;
  candidate.cost = 12.5;
  candidate.terms = {{"duration", 10.0}, {"obstacle", 2.5}};
  candidate.motion = straight_drive(1.7e9, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5);
  candidate.selected = true;
  candidate.fallbacks = {{FallbackKind::kLatticePath, {4.0, 0.0}}};
  const auto message = to_message(candidate, "map", kStamp);
  EXPECT_EQ(message.signature.size(), 2u);
  EXPECT_EQ(message.signature[1], -1);
  EXPECT_TRUE(message.selected);
  EXPECT_EQ(message.cost, 12.5);
  ASSERT_EQ(message.terms.size(), 2u);
  EXPECT_EQ(message.terms[1].name, "obstacle");
  EXPECT_EQ(message.terms[1].value, 2.5);
  EXPECT_NEAR(message.length, 8.0, 0.01);
  EXPECT_NEAR(message.duration, candidate.motion.end_time() - 1.7e9, 1e-6);
  EXPECT_GT(message.path.size(), 20u);
  EXPECT_NEAR(message.path.back().x, 8.0, 1e-6);
  EXPECT_EQ(message.status.message, "solved");
  ASSERT_EQ(message.status.effort.fallbacks.size(), 1u);
  EXPECT_EQ(message.status.effort.fallbacks[0].kind, mocha_ugv::Fallback::LATTICE_PATH);
  EXPECT_EQ(message.status.effort.fallbacks[0].plans, 0u);
}

TEST(StatusConversions, ACandidateWithoutAMotionSaysWhy) {
  PlanCandidate candidate;
  candidate.violation = violation();
  const auto message = to_message(candidate, "map", kStamp);
  EXPECT_TRUE(message.path.empty());
  EXPECT_EQ(message.status.reason, mocha_ugv::PlannerStatus::NOT_CERTIFIED);
  EXPECT_NE(message.status.message.find("ugv2"), std::string::npos);
}

}  // namespace
}  // namespace mocha
