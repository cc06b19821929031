#include "fleet/protocol/heartbeat_lines.h"

#include <string>
#include <utility>
#include <vector>

namespace mocha {

void HeartbeatLines::add(const PeerTable& peers, const Neighbourhood& here, double now,
                         Heartbeat& heartbeat) {
  std::vector<LineRota::Entry> acknowledged;
  std::vector<LineRota::Entry> echoed;
  for (const auto& [name, peer] : peers.peers()) {
    const double urgency = here.urgency(peer);
    if (peers.acknowledgement(name, now)) acknowledged.push_back({name, urgency});
    if (peers.echo(name, now)) echoed.push_back({name, urgency});
  }
  for (const std::string& name : acknowledged_.take(std::move(acknowledged), now))
    heartbeat.acknowledgements.push_back(*peers.acknowledgement(name, now));
  for (const std::string& name : echoed_.take(std::move(echoed), now))
    heartbeat.echoes.push_back(*peers.echo(name, now));
}

}  // namespace mocha
