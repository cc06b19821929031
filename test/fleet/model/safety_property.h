#pragma once

#include <string>

#include "fleet/model/protocol_model.h"

namespace mocha::test {

/// Returns which driven motion the one that settles at robot i now, and was proposed at `since_s`
/// of its clock, meets although it must not; empty: none.
///
/// It must not meet what the tracker of a robot j drives or has promised, if j is in reach and
/// bound that before the proposal was made: then j was asked, and had to object. Nor what j bound,
/// without emergency, while i was in its reach: then i was asked and agreed, and has to remember
/// that until it is started anew. The protocol promises no more.
std::string safety_violation(const ProtocolModel& model, int i, const CommittedTrajectory& settles,
                             double since_s);

}  // namespace mocha::test
