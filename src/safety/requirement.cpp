#include "safety/requirement.h"

#include "world/margin_budget.h"

namespace mocha {
namespace {

constexpr double kPeerSlack_m = 0.01;     // so that a proof today still holds tomorrow
constexpr double kShareInForce = 0.7;     // of the clearance to people
constexpr double kShareOfTrigger = 0.75;  // of the same, below which paper (37) is met
// A promise made now holds for predictions that reach farther, so that it need not be replaced as
// soon as they do.
constexpr double kReserve_s = 1.0;
constexpr double kHorizon_s = 10.0;  // of what never comes to rest
// Of way, beyond twice the length of the body, after which it has the margin if it begins too
// close.
constexpr double kLeaving_m = 1.0;
// Of a cell, beyond what the body is covered with: no cell that is occupied has its middle under
// it.
constexpr double kShareOfCell = 0.75;

}  // namespace

Requirement Requirement::from(double from) const {
  Requirement later = *this;
  later.from_s = from;
  return later;
}

Requirement Requirement::joining_at(double join) const {
  Requirement later = *this;
  later.limits_from_s = join;
  return later;
}

Requirement Requirement::until(double until) const {
  Requirement shorter = *this;
  shorter.until_s = until;
  return shorter;
}

double distance_to_peers_m(const RobotModel& robot) {
  return robot.footprint.circumscribed_radius_m() + robot.peer_clearance_m +
         MarginBudget::of(robot).peer_margin_m();
}

const char* to_text(RequirementName name) {
  switch (name) {
    case RequirementName::kPlan:
      return "plan";
    case RequirementName::kDetour:
      return "detour";
    case RequirementName::kDetourLikely:
      return "detour on the likely course";
    case RequirementName::kEmergencyDetour:
      return "emergency detour";
    case RequirementName::kPromise:
      return "promise";
    case RequirementName::kPromiseLikely:
      return "promise on the likely course";
    case RequirementName::kRenewal:
      return "renewal";
    case RequirementName::kEmergency:
      return "emergency";
    case RequirementName::kEscape:
      return "escape";
    case RequirementName::kTrigger:
      return "trigger";
    case RequirementName::kTriggerLikely:
      return "trigger on the likely course";
    case RequirementName::kNone:
      return "none";
  }
  return "unknown";
}

Requirements::Requirements(const RobotModel& robot) {
  using Name = RequirementName;
  const MarginBudget margins = MarginBudget::of(robot);
  const auto from_people_m = [&](double share) {
    return robot.footprint.circumscribed_radius_m() + margins.own_margin_m() +
           share * robot.moving_clearance_m;
  };
  Requirement plan;
  plan.limits = robot.limits;
  plan.obstacle_margin = margins.static_margin();
  plan.leaving = {kLeaving_m + 4.0 * robot.footprint.circumscribed_radius_m(),
                  kShareOfCell * robot.map_resolution_m + Footprint::kCoverTolerance_m};
  at(Name::kPlan) = plan;

  Requirement detour = at(Name::kPlan);
  detour.peer_distance_m = distance_to_peers_m(robot) + kPeerSlack_m;
  detour.predicted_distance_m = from_people_m(1.0);
  at(Name::kDetour) = at(Name::kDetourLikely) = detour;

  Requirement promise = detour;
  promise.unseen_margin = margins.static_margin();
  if (robot.stops_checked) promise.stops = StopOptions{robot.braking(), robot.peer_reaction_s};
  promise.stop_clearance_m = margins.peer_margin_m() + kPeerSlack_m;
  at(Name::kPromise) = at(Name::kPromiseLikely) = promise;

  Requirement trigger = promise;
  trigger.predicted_distance_m = from_people_m(kShareOfTrigger);
  at(Name::kTrigger) = at(Name::kTriggerLikely) = trigger;

  // An emergency breaks promises: its peers have to heed it, not it them.
  Requirement emergency = promise;
  emergency.stops.reset();
  emergency.limits = robot.emergency_limits();
  at(Name::kEmergency) = at(Name::kEscape) = emergency;
  at(Name::kEscape).predicted_distance_m.reset();
  at(Name::kEmergencyDetour) = emergency;
  at(Name::kEmergencyDetour).unseen_margin.reset();

  Requirement renewal = emergency;
  renewal.obstacle_margin = margins.without_map();
  renewal.unseen_margin = margins.without_map();
  renewal.peer_distance_m = distance_to_peers_m(robot) - kPeerSlack_m;
  renewal.predicted_distance_m = from_people_m(kShareInForce);
  renewal.reserve_s = kReserve_s;
  at(Name::kRenewal) = renewal;

  for (const Name name : {Name::kDetourLikely, Name::kEmergencyDetour, Name::kPromiseLikely,
                          Name::kRenewal, Name::kEmergency, Name::kEscape, Name::kTriggerLikely})
    at(name).course = Course::kLikely;
}

std::vector<MovingThing> kept_apart(const Scene& scene, const Requirement& requirement) {
  std::vector<MovingThing> things;
  if (requirement.peer_distance_m) {
    for (const auto& peer : scene.peers)
      things.push_back({peer, *requirement.peer_distance_m, requirement.from_s + kHorizon_s});
  }
  if (!requirement.predicted_distance_m) return things;
  const bool likely = requirement.course == Course::kLikely && !scene.likely.empty();
  const double known_s = scene.predicted_until_s - requirement.reserve_s;
  const bool ends = known_s < std::numeric_limits<double>::infinity();
  const double until_s = ends ? known_s : requirement.from_s + kHorizon_s;
  for (const auto& thing : likely ? scene.likely : scene.confident)
    things.push_back({thing, *requirement.predicted_distance_m, until_s});
  return things;
}

}  // namespace mocha
