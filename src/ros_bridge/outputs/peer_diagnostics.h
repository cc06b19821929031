#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <functional>
#include <optional>
#include <string>

#include "fleet/protocol/peer_table.h"

namespace mocha {

/// What is known of the peers and of the way to them: age, epoch, promise, loss, delay, clock.
/// `loss` gives the share of a peer's messages that do not come, where it is known. Warns of all
/// that promises have to wait for.
void diagnose_peers(const PeerTable& peers, double now_s, double delta_dc_s,
                    const std::function<std::optional<double>(const std::string&)>& loss,
                    diagnostic_updater::DiagnosticStatusWrapper& status);

}  // namespace mocha
