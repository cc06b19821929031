#include "planning/replanner/ladder.h"

namespace mocha {
namespace {

using K = ManeuverKind;
using R = RequirementName;

// How a row binds, settled or at once, is the maneuver's: it knows how much time there is.
constexpr Rung kRejoinSooner{Row::kRejoinSooner, K::kRejoinSooner, R::kPromise, false};
constexpr Rung kFollow{Row::kFollow, K::kFollow, R::kPromise, false};
constexpr Rung kDetour{Row::kDetour, K::kDetour, R::kPromise, false};
constexpr Rung kWeave{Row::kWeave, K::kWeave, R::kPromiseLikely, false};
constexpr Rung kDetourLikely{Row::kDetourLikely, K::kDetour, R::kPromiseLikely, false};
constexpr Rung kStop{Row::kStop, K::kStop, R::kRenewal, true};
constexpr Rung kBrakeSoon{Row::kBrakeSoon, K::kBrakeSoon, R::kPromise, true};
constexpr Rung kBrakeInTime{Row::kBrakeInTime, K::kBrakeInTime, R::kPromise, true};
constexpr Rung kBrakeInTimeAtOnce{Row::kBrakeInTimeAtOnce, K::kBrakeInTimeAtOnce, R::kPromise,
                                  true};
constexpr Rung kBrakeLikely{Row::kBrakeLikely, K::kBrakeSoon, R::kPromiseLikely, true};
constexpr Rung kBrakeInTimeLikely{Row::kBrakeInTimeLikely, K::kBrakeInTime, R::kPromiseLikely,
                                  true};
constexpr Rung kBrakeInTimeAtOnceLikely{Row::kBrakeInTimeAtOnceLikely, K::kBrakeInTimeAtOnce,
                                        R::kPromiseLikely, true};
constexpr Rung kSidestep{Row::kSidestep, K::kSidestep, R::kPromise, true};
constexpr Rung kSidestepLikely{Row::kSidestepLikely, K::kSidestep, R::kPromiseLikely, true};
constexpr Rung kBrakeHard{Row::kBrakeHard, K::kBrakeHard, R::kRenewal, true};
constexpr Rung kEmergencyDetour{Row::kEmergencyDetour, K::kEmergencyDetour, R::kEmergency, true};
constexpr Rung kMostRoom{Row::kMostRoom, K::kMostRoom, R::kEscape, true};
constexpr Rung kLastResort{Row::kLastResort, K::kLastResort, R::kNone, true};
constexpr Rung kBrakeAnyway{Row::kLastResort, K::kBrakeHard, R::kNone, true};

}  // namespace

const std::vector<Rung>& ladder_of(Situation situation) {
  static const std::vector<Rung> kHolds = {kRejoinSooner, kFollow, kDetour, kDetourLikely};
  static const std::vector<Rung> kPlanMeets = {kDetour, kWeave, kDetourLikely, kFollow};
  static const std::vector<Rung> kInTurn = {kFollow};
  static const std::vector<Rung> kThreatened = {kFollow,
                                                kDetour,
                                                kWeave,
                                                kDetourLikely,
                                                kBrakeSoon,
                                                kBrakeInTime,
                                                kBrakeInTimeAtOnce,
                                                kBrakeLikely,
                                                kBrakeInTimeLikely,
                                                kBrakeInTimeAtOnceLikely,
                                                kSidestep,
                                                kSidestepLikely,
                                                kBrakeHard,
                                                kEmergencyDetour,
                                                kMostRoom,
                                                kLastResort};
  static const std::vector<Rung> kBlocked = {kFollow,
                                             kDetour,
                                             kDetourLikely,
                                             kBrakeInTime,
                                             kBrakeInTimeAtOnce,
                                             kBrakeInTimeLikely,
                                             kBrakeInTimeAtOnceLikely,
                                             kSidestep,
                                             kSidestepLikely,
                                             kBrakeHard,
                                             kEmergencyDetour,
                                             kBrakeAnyway};
  static const std::vector<Rung> kInTheWay = {kFollow,          kDetour,   kWeave,
                                              kDetourLikely,    kSidestep, kSidestepLikely,
                                              kEmergencyDetour, kMostRoom, kLastResort};
  static const std::vector<Rung> kNoGoal = {kStop};
  switch (situation) {
    case Situation::kHolds:
      return kHolds;
    case Situation::kPlanMeets:
      return kPlanMeets;
    case Situation::kInTurn:
      return kInTurn;
    case Situation::kThreatened:
      return kThreatened;
    case Situation::kBlocked:
      return kBlocked;
    case Situation::kInTheWay:
      return kInTheWay;
    case Situation::kNoGoal:
      return kNoGoal;
  }
  return kHolds;
}

const char* to_text(Row row) {
  switch (row) {
    case Row::kKeep:
      return "keeps its promise";
    case Row::kWait:
      return "waits for an answer";
    case Row::kStand:
      return "promises to stand";
    case Row::kStopHere:
      return "brakes from where it is";
    case Row::kStopBlind:
      return "brakes for lack of data";
    case Row::kEmergencyStop:
      return "emergency stop";
    case Row::kFollow:
      return "follows the plan";
    case Row::kRejoinSooner:
      return "shortens its detour";
    case Row::kDetour:
      return "detour";
    case Row::kWeave:
      return "weaves through";
    case Row::kDetourLikely:
      return "detour past the likely course";
    case Row::kStop:
      return "stops: no goal";
    case Row::kBrakeSoon:
      return "brakes";
    case Row::kBrakeInTime:
      return "brakes in time";
    case Row::kBrakeInTimeAtOnce:
      return "brakes in time, at once";
    case Row::kBrakeLikely:
      return "brakes before the likely course";
    case Row::kBrakeInTimeLikely:
      return "brakes in time before the likely course";
    case Row::kBrakeInTimeAtOnceLikely:
      return "brakes in time before the likely course, at once";
    case Row::kSidestep:
      return "sidestep";
    case Row::kSidestepLikely:
      return "sidestep out of the likely course";
    case Row::kBrakeHard:
      return "brakes hard";
    case Row::kEmergencyDetour:
      return "emergency detour";
    case Row::kMostRoom:
      return "keeps the most room";
    case Row::kLastResort:
      return "NO CERTIFIED MOTION EXISTS";
  }
  return "unknown";
}

}  // namespace mocha
