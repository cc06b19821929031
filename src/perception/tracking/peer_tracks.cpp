#include "perception/tracking/peer_tracks.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace mocha {
namespace {

// Scans wait this long for their transforms at most; a motion may still be needed that long after
// its successor began.
constexpr double kMemory_s = 2.0;

const PeerMotion& begun_at(const std::vector<PeerMotion>& track, double t) {
  for (auto it = track.rbegin(); it != track.rend(); ++it) {
    if (it->motion->start_time() <= t) return *it;
  }
  return track.front();
}

}  // namespace

PeerTracks::PeerTracks(double margin_m, double timeout_s)
    : margin_m_(margin_m), timeout_s_(timeout_s) {
  if (!(margin_m >= 0.0)) throw std::invalid_argument("PeerTracks: margin must be at least 0 m");
  if (!(timeout_s > 0.0)) throw std::invalid_argument("PeerTracks: timeout must be above 0 s");
}

void PeerTracks::update(double stamp_s, const std::vector<PeerMotion>& peers) {
  std::map<std::string, std::vector<PeerMotion>> tracks;
  for (const PeerMotion& peer : peers) {
    std::vector<PeerMotion>& track = tracks[peer.name];
    if (const auto former = tracks_.find(peer.name); former != tracks_.end() && track.empty()) {
      track = former->second;
    }
    const bool known = std::any_of(track.begin(), track.end(),
                                   [&](const PeerMotion& each) { return each.id == peer.id; });
    if (!known) track.push_back(peer);
    const auto needed = std::find_if(track.begin() + 1, track.end(), [&](const PeerMotion& next) {
      return next.motion->start_time() > stamp_s - kMemory_s;
    });
    track.erase(track.begin(), needed - 1);
  }
  tracks_ = std::move(tracks);
  stamp_s_ = stamp_s;
}

std::vector<PeerTracks::Disc> PeerTracks::at(double t) const {
  std::vector<Disc> discs;
  if (t > stamp_s_ + timeout_s_) return discs;
  for (const auto& [name, track] : tracks_) {
    const PeerMotion& peer = begun_at(track, t);
    discs.push_back({peer.motion->at(t).pose.position, peer.radius_m});
  }
  return discs;
}

int PeerTracks::ignore_peers(std::vector<Beam>& beams) const {
  int ignored = 0;
  double time_s = std::numeric_limits<double>::quiet_NaN();
  std::vector<Disc> discs;
  for (Beam& beam : beams) {
    if (beam.time_s != time_s) {
      discs = at(beam.time_s);
      time_s = beam.time_s;
    }
    const bool on_peer = std::any_of(discs.begin(), discs.end(), [&](const Disc& disc) {
      return (beam.end.head<2>() - disc.centre).norm() <= disc.radius_m + margin_m_;
    });
    if (beam.kind != BeamEnd::kHit || !on_peer) continue;
    beam.kind = BeamEnd::kIgnored;
    ++ignored;
  }
  return ignored;
}

}  // namespace mocha
