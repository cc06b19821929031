#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "fleet/protocol/committed_trajectory.h"
#include "fleet/protocol/emergency_stop.h"
#include "fleet/protocol/passing_messages.h"
#include "fleet/wire/fleet_key.h"

namespace mocha {

// Promises, heartbeats, what is said about passing and emergency stops as bytes on the network: LCM
// messages (lcm/datagram_t.lcm) of one datagram each. Numbers are quantised: times to 1 us, places
// to 0.01 mm, headings, speeds and accelerations to 1e-5 rad, m/s and m/s^2, turns in place to 1e-7
// rad, radii to 1 mm (up), reaches to 1 cm (up), braking to 1 mm/s^2. So that all robots hold the
// same motion, the one that promises drives quantised(), too; RobotModel::braking() needs no
// rounding.

/// Of everything below; others are refused.
constexpr int kWireVersion = 7;

/// What a datagram holds at most, LCM's own header with a channel of up to 15 characters included:
/// larger ones would be cut into fragments, each of which may get lost.
constexpr std::size_t kMostDatagramBytes = 1400;

using FleetMessage =
    std::variant<CommittedTrajectory, Heartbeat, PassingIntent, PassingInstruction, FleetStops>;

struct Datagram {
  std::uint32_t number = 0;  ///< the sender counts its datagrams since its start
  FleetMessage message;
};

/// Sealed where there is a key. Throws std::invalid_argument, saying what is wrong, for what is
/// none of validate()'s promises, for numbers out of range (a motion of more than 21 km), and for
/// what does not fit into one datagram.
std::vector<std::uint8_t> encode(const Datagram& datagram, const FleetKey* key = nullptr);

enum class SealFault {
  kUnsealed,     ///< no seal, but there is a key
  kForeignSeal,  ///< a seal, but of another key, or broken on the way
  kNoKey,        ///< a seal, but no key to tell by
};

/// Bytes that are no datagram of a robot that holds the same key.
class SealError : public std::invalid_argument {
 public:
  SealError(SealFault fault, const std::string& what) : std::invalid_argument(what), fault(fault) {}
  const SealFault fault;
};

/// What is in these bytes. Throws SealError where they do not suit the key (or its absence), and
/// std::invalid_argument, saying what is wrong, for whatever encode() did not make, or may have
/// come to harm on the way: it takes no more time and memory for them than for a message of their
/// size.
Datagram decode(const std::uint8_t* data, std::size_t size, const FleetKey* key = nullptr);

/// The same heartbeat in as many as it takes for each to fit into a datagram; what it says of the
/// sender is in all of them.
std::vector<Heartbeat> in_datagrams(const Heartbeat& heartbeat);

/// The promise as its receivers decode it. Throws as encode() does, and where the quantised motion
/// is not valid any more. Quantised again it stays as it is.
CommittedTrajectory quantised(const CommittedTrajectory& trajectory);

/// The same for the motion alone.
Motion quantised(const Motion& motion);

/// Whether a motion can be said in one datagram, whatever the robot's name.
bool fits(const Motion& motion);

/// Whether so much of an instruction can be said in one datagram. Throws as encode() does for what
/// cannot be said at all.
bool fits(const PassingInstruction& instruction);

}  // namespace mocha
