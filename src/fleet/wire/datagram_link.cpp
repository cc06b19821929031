#include "fleet/wire/datagram_link.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace mocha {
namespace {

constexpr std::size_t kRemembered = 64;  // own datagrams that may still come back

std::pair<std::string, std::uint32_t> sender_of(const FleetMessage& message) {
  if (const auto* trajectory = std::get_if<CommittedTrajectory>(&message))
    return {trajectory->agent, trajectory->id.epoch};
  if (const auto* intent = std::get_if<PassingIntent>(&message))
    return {intent->agent, intent->epoch};
  if (const auto* instruction = std::get_if<PassingInstruction>(&message))
    return {instruction->id.leader, instruction->id.epoch};
  if (const auto* stops = std::get_if<FleetStops>(&message)) return {stops->agent, stops->epoch};
  const Heartbeat& heartbeat = std::get<Heartbeat>(message);
  return {heartbeat.agent, heartbeat.epoch};
}

}  // namespace

DatagramLink::DatagramLink(std::string agent, const std::optional<FleetKey>& key)
    : agent_(std::move(agent)), key_(key) {}

std::vector<DatagramLink::Bytes> DatagramLink::pack(const FleetMessage& message) {
  if (!std::holds_alternative<Heartbeat>(message)) return {send(message)};
  std::vector<Bytes> datagrams;
  for (const Heartbeat& heartbeat : in_datagrams(std::get<Heartbeat>(message)))
    datagrams.push_back(send(heartbeat));
  return datagrams;
}

DatagramLink::Bytes DatagramLink::send(const FleetMessage& message) {
  Bytes bytes = encode({number_ + 1, message}, key_ ? &*key_ : nullptr);
  ++number_;
  ++counts_.sent;
  sent_.push_back(bytes);
  if (sent_.size() > kRemembered) sent_.pop_front();
  return bytes;
}

std::optional<FleetMessage> DatagramLink::unpack(const std::uint8_t* data, std::size_t size) {
  try {
    return take(decode(data, size, key_ ? &*key_ : nullptr), data, size);
  } catch (const SealError& error) {
    refuse(error.fault == SealFault::kUnsealed ? counts_.unsealed : counts_.foreign, error.what());
  } catch (const std::invalid_argument& error) {
    refuse(counts_.malformed, error.what());
  }
  return std::nullopt;
}

std::optional<FleetMessage> DatagramLink::take(Datagram datagram, const std::uint8_t* data,
                                               std::size_t size) {
  const auto [sender, epoch] = sender_of(datagram.message);
  if (sender == agent_) {
    const auto mine = std::find_if(sent_.begin(), sent_.end(), [&](const Bytes& bytes) {
      return std::equal(bytes.begin(), bytes.end(), data, data + size);
    });
    if (mine != sent_.end()) {
      ++counts_.own;
    } else {
      refuse(counts_.impostors, "another robot is called " + agent_ + ", too, or was recorded");
    }
    return std::nullopt;
  }
  if (senders_.size() >= kMostSenders && senders_.count(sender) == 0) {
    refuse(counts_.crowded_out, "there are too many robots to hear " + sender + ", too");
    return std::nullopt;
  }
  if (!senders_[sender].take(epoch, datagram.number)) {
    ++counts_.repeated;
    // A robot that lost the count of its starts is told so by the peers that hear its heartbeat.
    const bool lost_count = senders_[sender].is_past(epoch);
    if (!lost_count || !std::holds_alternative<Heartbeat>(datagram.message)) return std::nullopt;
    return std::move(datagram.message);
  }
  ++counts_.taken;
  return std::move(datagram.message);
}

void DatagramLink::refuse(int& count, const std::string& why) {
  ++count;
  last_refusal_ = why;
}

std::optional<double> DatagramLink::loss(const std::string& sender) const {
  const auto found = senders_.find(sender);
  if (found == senders_.end()) return std::nullopt;
  return found->second.loss();
}

}  // namespace mocha
