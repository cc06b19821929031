#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include "fleet/protocol/commitment_protocol.h"
#include "stack/commitment_keeping.h"

namespace mocha {

/// What a robot has promised, and what became of its proposals.
void diagnose_promises(const CommitmentProtocol& protocol, const CommitmentKeeping& keeping,
                       double now_s, diagnostic_updater::DiagnosticStatusWrapper& status);

}  // namespace mocha
