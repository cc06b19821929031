#pragma once

#include <optional>

#include "fleet/protocol/reservation_chain.h"

namespace mocha {

/// What is binding for a robot, and what it proposes, if anything. Both must outlive this.
struct Future {
  const ReservationChain& binding;
  const CommittedTrajectory* proposal;
};

/// What robots keep where one of them brakes.
struct StopDemand {
  double reaction_s;        ///< from the moment at which the one brakes until the other does
  double clearance_m;       ///< between the discs
  double apart_m;           ///< the centres now: too close already, they may come no closer
  double mistimed_s = 0.0;  ///< motions of theirs may be early or late by so much
};

/// The first moment from `now` on at which either robot must not brake along its path, each as it
/// promises to brake: see first_stop_meeting(). Far robots cost a comparison of boxes.
std::optional<Conflict> first_stop_conflict(const Future& mine, const Future& theirs,
                                            const StopDemand& demand, double now);

}  // namespace mocha
