#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fleet/wire/fleet_key.h"
#include "fleet/wire/replay_guard.h"
#include "fleet/wire/wire_format.h"

namespace mocha {

/// One robot's end of the fleet network, but for the network itself: its messages become numbered
/// and, where there is a key, sealed datagrams; what comes back are messages of others, each once
/// but for heartbeats of former epochs, which PeerTable answers and else makes nothing of. Whatever
/// else comes is counted and forgotten.
class DatagramLink {
 public:
  using Bytes = std::vector<std::uint8_t>;

  /// Senders whose numbers are remembered: no more than PeerTable knows.
  static constexpr std::size_t kMostSenders = 2000;

  /// Datagrams that came, and what became of them.
  struct Counts {
    int sent = 0;
    int taken = 0;
    int own = 0;        ///< from this robot, as multicast gives them back
    int repeated = 0;   ///< had come before, or are too old to tell
    int unsealed = 0;   ///< but this robot has a key
    int foreign = 0;    ///< sealed with another key, or with one where this robot has none
    int malformed = 0;  ///< of another version, cut, or nonsense
    int impostors = 0;  ///< bear this robot's name, but it did not send them
    int crowded_out = 0;

    /// What should not happen on a network of one fleet.
    int refused() const { return unsealed + foreign + malformed + impostors + crowded_out; }
  };

  /// Without a key, every sender on the network is trusted.
  DatagramLink(std::string agent, const std::optional<FleetKey>& key);

  /// Throws as encode() does. A long heartbeat becomes several datagrams.
  std::vector<Bytes> pack(const FleetMessage& message);

  /// The message of another robot in these bytes, if that is what they are.
  std::optional<FleetMessage> unpack(const std::uint8_t* data, std::size_t size);

  const Counts& counts() const { return counts_; }
  /// Why the last one was refused, for a human.
  const std::string& last_refusal() const { return last_refusal_; }
  /// Share of its newest datagrams that did not come; none where it is not known.
  std::optional<double> loss(const std::string& sender) const;
  bool has_key() const { return key_.has_value(); }

 private:
  Bytes send(const FleetMessage& message);
  std::optional<FleetMessage> take(Datagram datagram, const std::uint8_t* data, std::size_t size);
  void refuse(int& count, const std::string& why);

  std::string agent_;
  std::optional<FleetKey> key_;
  std::uint32_t number_ = 0;
  std::deque<Bytes> sent_;  // the newest, to know them again
  std::map<std::string, ReplayGuard> senders_;
  Counts counts_;
  std::string last_refusal_;
};

}  // namespace mocha
