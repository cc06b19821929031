#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "fleet/protocol/committed_trajectory.h"
#include "fleet/protocol/reservation_chain.h"

namespace mocha {

/// A motion that the robot would like to make its promise.
struct Proposal {
  std::uint32_t tag = 0;  ///< the proposer's own number; comes back in the events
  double footprint_radius_m = 0.0;
  std::optional<Braking> braking;
  std::shared_ptr<const Motion> motion;
};

/// Why a proposal did not become binding. The numbers are those of mocha_ugv/Settlement.
enum class Refusal : std::uint8_t {
  kNone,
  kListening,      ///< just started: its peers are not known yet
  kTooLate,        ///< its start came before it was settled, or has passed already
  kDiscontinuous,  ///< does not begin where the binding motion will be
  kPeerPromise,    ///< comes too close to what a peer has promised
  kPeerProposal,   ///< meets a peer's proposal that came first, or one of the same time that ranks
                   ///< higher
  kUnanswered,     ///< like kTooLate, because of a peer in reach that did not agree in time
  kClock,          ///< like kTooLate, because what a peer's clock shows is not known
  kReplaced,       ///< by a newer proposal of its own robot
  kEmergency,      ///< its own robot brakes
};

/// In a word, for reports: "peer_promise".
const char* name_of(Refusal refusal);

struct CommitmentEvent {
  enum class Kind {
    kSettled,    ///< the motion is binding
    kRejected,   ///< it is not, by the rules; `refusal` says why
    kWithdrawn,  ///< its own robot has something newer (kReplaced, kEmergency)
    kBreached,   ///< a peer's binding motion meets our binding one: it brakes, or was out of reach
  };
  Kind kind = Kind::kSettled;
  Refusal refusal = Refusal::kNone;
  CommittedTrajectory trajectory;  ///< ours; as sent, if it was sent
  Proposal proposal;               ///< as it came from the proposer
  Conflict conflict;  ///< its peer is set where one was involved; the rest where two motions meet
};

/// What follows from a call: messages to every peer, in this order, and news for the own robot.
struct CommitmentActions {
  std::vector<CommittedTrajectory> trajectories;
  std::optional<Heartbeat> heartbeat;
  std::vector<CommitmentEvent> events;
};

}  // namespace mocha
