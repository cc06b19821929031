#include "fleet/protocol/stop_conflict.h"

#include <algorithm>
#include <vector>

#include "trajectory/separation.h"
#include "trajectory/stop_separation.h"

namespace mocha {
namespace {

std::vector<const CommittedTrajectory*> promises_of(const Future& future) {
  std::vector<const CommittedTrajectory*> trajectories;
  for (const Reservation& reservation : future.binding.reservations())
    trajectories.push_back(&reservation.trajectory);
  if (future.proposal != nullptr) trajectories.push_back(future.proposal);
  return trajectories;
}

double distance_m(const CommittedTrajectory& mine, const CommittedTrajectory& theirs,
                  double clearance_m) {
  return mine.footprint_radius_m + theirs.footprint_radius_m + clearance_m;
}

bool all_far_apart(const Future& mine, const Future& theirs, double clearance_m) {
  const std::vector<const CommittedTrajectory*> others = promises_of(theirs);
  for (const CommittedTrajectory* own : promises_of(mine)) {
    for (const CommittedTrajectory* other : others) {
      if (!far_apart(*own->motion, *other->motion, distance_m(*own, *other, clearance_m)))
        return false;
    }
  }
  return true;
}

BrakableMotion brakable(const CommittedTrajectory& trajectory, double mistimed_s = 0.0) {
  return {*trajectory.motion, trajectory.braking.value(), mistimed_s};
}

std::vector<Reservation> parts_of(const Future& future, double now) {
  ReservationChain chain = future.binding;
  if (future.proposal != nullptr) chain.bind(*future.proposal);
  return chain.parts(now);
}

std::optional<Conflict> first_conflict_of(const Reservation& mine, const Reservation& theirs,
                                          const StopDemand& demand, double now) {
  const double from = std::max({mine.from_s, theirs.from_s - demand.mistimed_s, now});
  const double until = std::min(mine.until_s, theirs.until_s + demand.mistimed_s);
  if (from >= until) return std::nullopt;
  const double required_m =
      std::min(demand.apart_m, distance_m(mine.trajectory, theirs.trajectory, demand.clearance_m));
  const auto meeting =
      first_stop_meeting(brakable(mine.trajectory), brakable(theirs.trajectory, demand.mistimed_s),
                         required_m, demand.reaction_s, from, until);
  if (!meeting) return std::nullopt;
  return Conflict{theirs.trajectory.agent, meeting->time_s,
                  meeting->distance_m,     required_m,
                  meeting->place,          true};
}

}  // namespace

std::optional<Conflict> first_stop_conflict(const Future& mine, const Future& theirs,
                                            const StopDemand& demand, double now) {
  if (all_far_apart(mine, theirs, demand.clearance_m)) return std::nullopt;
  const std::vector<Reservation> their_parts = parts_of(theirs, now);
  for (const Reservation& part : parts_of(mine, now)) {
    for (const Reservation& their_part : their_parts) {
      if (auto conflict = first_conflict_of(part, their_part, demand, now)) return conflict;
    }
  }
  return std::nullopt;
}

}  // namespace mocha
