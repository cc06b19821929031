#pragma once

#include <string>

#include "fleet/model/protocol_model.h"

namespace mocha::test {

/// Returns which driven motion the one that settles at robot i now, and was proposed at `since_s`
/// of its clock, meets although it must not; empty: none.
///
/// Two kinds of what the tracker of a robot j drives or has promised count. What j bound before the
/// proposal was made, if j is in reach: j was asked, and had to object. What j bound without
/// emergency while i was in its reach: i was asked and agreed, and remembers that until it is
/// started anew. The protocol promises no more.
std::string safety_violation(const ProtocolModel& model, int i, const CommittedTrajectory& settles,
                             double since_s);

}  // namespace mocha::test
