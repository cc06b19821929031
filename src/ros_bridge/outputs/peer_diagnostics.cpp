#include "ros_bridge/outputs/peer_diagnostics.h"

#include <cstdio>

namespace mocha {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;

std::string seconds(double value_s) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f s", value_s);
  return text;
}

void warn_of_clock(const std::string& name, const Peer& peer, const PeerTable& peers,
                   const ClockReading& clock, double delta_dc_s, double now_s,
                   DiagnosticStatusWrapper& status) {
  const auto warn = [&](const std::string& what) {
    status.mergeSummary(DiagnosticStatus::WARN, name + what);
  };
  if (clock.delay_s > delta_dc_s) warn(": messages take longer than delta_dc");
  if (peers.clock_differs(peer, now_s))
    warn(": its clock is ahead by " + seconds(clock.offset_s) + "; set both by chrony");
  if (!peers.clock_known(peer, now_s))
    warn(": its clock cannot be told well enough, nothing is settled with it");
}

}  // namespace

void diagnose_peers(const PeerTable& peers, double now_s, double delta_dc_s,
                    const std::function<std::optional<double>(const std::string&)>& loss,
                    DiagnosticStatusWrapper& status) {
  for (const auto& [name, peer] : peers.peers()) {
    const bool in_reach = peers.in_reach(peer, now_s);
    status.addf("peer " + name, "%s, heard %.2f s ago, epoch %u, promise %u",
                in_reach ? "in reach" : "out of reach", now_s - peer.last_heard_s, peer.epoch,
                peer.binding.empty() ? 0 : peer.binding.newest().id.sequence);
    if (!in_reach)
      status.mergeSummary(DiagnosticStatus::WARN,
                          name + " is out of reach; its last promise still counts");
    if (const auto share = loss(name)) status.addf(name + " loss", "%.0f %%", 100.0 * *share);
    const auto clock = peer.clock.reading(now_s);
    if (!clock) {
      if (in_reach) status.mergeSummary(DiagnosticStatus::WARN, name + " does not hear this robot");
      continue;
    }
    status.add(name + " delay", seconds(clock->delay_s));
    status.add(name + " clock ahead",
               seconds(clock->offset_s) + ", give or take " + seconds(clock->uncertainty_s));
    status.add(name + " mistimed beyond margin_clock", seconds(peers.mistimed_s(peer, now_s)));
    if (in_reach) warn_of_clock(name, peer, peers, *clock, delta_dc_s, now_s, status);
  }
  if (peers.unlikely_epochs() > 0) {
    status.add("starts of this robot told that cannot be", peers.unlikely_epochs());
    status.mergeSummary(
        DiagnosticStatus::WARN,
        "peers say that this robot was started oftener than it can have been: "
        "another sender spoke in its name, and they do not hear it until started anew");
  }
  status.add("duplicates", peers.duplicates());
  status.add("messages older than known", peers.old_messages());
  status.add("messages of too many peers", peers.crowded_out());
}

}  // namespace mocha
