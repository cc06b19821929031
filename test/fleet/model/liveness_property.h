#pragma once

#include <string>

#include "fleet/model/protocol_model.h"

namespace mocha::test {

/// Returns what is wrong if from now on no harm is done and nothing new is proposed; empty:
/// nothing.
///
/// Every pending proposal must end, and for a better reason than that its time ran out, where there
/// is enough of it; and of robots that propose, and do nothing else, one must settle.
std::string liveness_violation(const ProtocolModel& model);

}  // namespace mocha::test
