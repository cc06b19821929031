#include "fleet/model/safety_property.h"

#include <algorithm>
#include <cmath>

#include "trajectory/separation.h"

namespace mocha::test {
namespace {

constexpr double kRounding_m = 2e-3;

/// A reservation of robot j, by the clock of robot i.
Reservation told_by(const ProtocolModel& model, Reservation theirs, int j, int i) {
  const double later_s = model.now(i) - model.now(j);
  if (later_s == 0.0) return theirs;
  theirs.trajectory = reclocked(theirs.trajectory, later_s);
  theirs.from_s += later_s;
  theirs.until_s += later_s;
  return theirs;
}

/// What clocks that are taken to agree cost at most; margins allow for that.
double clocks_cost_m(const ProtocolModel& model, const Reservation& theirs, int j, int i) {
  const double apart_s = std::abs(model.now(i) - model.now(j));
  const bool agree = apart_s <= model.robot(i).protocol.options().clocks.tolerance_s;
  return agree ? apart_s * bounds(*theirs.trajectory.motion).speed : 0.0;
}

/// Whether the protocol promises that what robot i proposed then does not meet that binding of j.
bool counts(const ProtocolModel& model, int i, int j, const Binding& binding, double since_s) {
  const double bound_s = binding.time_s + model.now(i) - model.now(j);
  const bool in_reach = (model.reach(i) >> j & 1u) != 0;
  const bool agreed = (binding.asked >> i & 1u) != 0 && !binding.emergency;
  return agreed || (in_reach && bound_s <= since_s);
}

}  // namespace

std::string safety_violation(const ProtocolModel& model, int i, const CommittedTrajectory& settles,
                             double since_s) {
  const Reservation mine = reservation_of(settles);
  for (int j = 0; j < model.scenario().size(); ++j) {
    if (j == i) continue;
    const DrivenPromises& driven = model.robot(j).driven;
    for (const Reservation& each : driven.chain().reservations()) {
      if (!counts(model, i, j, driven.binding(each.trajectory.id), since_s)) continue;
      const Reservation theirs = told_by(model, each, j, i);
      const double required_m = settles.footprint_radius_m + theirs.trajectory.footprint_radius_m +
                                model.robot(i).protocol.options().peer_clearance_m - kRounding_m -
                                clocks_cost_m(model, theirs, j, i);
      const auto conflict = first_conflict(mine, theirs, required_m, model.now(i));
      if (!conflict) continue;
      return name_of_robot(i) + " settles what comes to " + std::to_string(conflict->distance_m) +
             " m of what " + name_of_robot(j) + " drives";
    }
  }
  return "";
}

}  // namespace mocha::test
