#include "ros_bridge/outputs/promise_diagnostics.h"

#include <algorithm>

namespace mocha {
namespace {

const char* text_of(CommitmentProtocol::State state) {
  switch (state) {
    case CommitmentProtocol::State::kListening:
      return "listening for peers";
    case CommitmentProtocol::State::kIdle:
      return "nothing promised";
    case CommitmentProtocol::State::kProposing:
      return "settling the first motion";
    case CommitmentProtocol::State::kBound:
      return "promised";
    case CommitmentProtocol::State::kRevising:
      return "promised, settling the next motion";
  }
  return "unknown";
}

}  // namespace

void diagnose_promises(const CommitmentProtocol& protocol, const CommitmentKeeping& keeping,
                       double now_s, diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  status.summary(DiagnosticStatus::OK, text_of(protocol.state()));
  const CommitmentKeeping::Counts& counts = keeping.counts();
  if (counts.breaches > 0) {
    status.mergeSummary(DiagnosticStatus::WARN, "peers broke promises that met ours");
  }
  status.add("epoch", protocol.epoch());
  if (!protocol.binding().empty()) {
    status.add("binding sequence", protocol.binding().newest().id.sequence);
  }
  status.addf("lease remaining (s)", "%.2f", std::max(0.0, keeping.lease_end_s() - now_s));
  status.add("stops as a lease ended", counts.lease_stops);
  for (const auto& [refusal, count] : counts.refusals)
    status.add("proposals refused: " + refusal, count);
  status.add("breaches", counts.breaches);
}

}  // namespace mocha
