#include "fleet/protocol/commitment_event.h"

namespace mocha {

const char* name_of(Refusal refusal) {
  switch (refusal) {
    case Refusal::kNone:
      return "none";
    case Refusal::kListening:
      return "listening";
    case Refusal::kTooLate:
      return "too_late";
    case Refusal::kDiscontinuous:
      return "discontinuous";
    case Refusal::kPeerPromise:
      return "peer_promise";
    case Refusal::kPeerProposal:
      return "peer_proposal";
    case Refusal::kUnanswered:
      return "unanswered";
    case Refusal::kClock:
      return "clock";
    case Refusal::kReplaced:
      return "replaced";
    case Refusal::kEmergency:
      return "emergency";
  }
  return "unknown";
}

}  // namespace mocha
