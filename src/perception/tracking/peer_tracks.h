#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "perception/sensor/beam.h"
#include "trajectory/braking.h"
#include "trajectory/motion.h"

namespace mocha {

/// A binding motion of a team-mate.
struct PeerMotion {
  std::string name;
  std::pair<std::uint32_t, std::uint32_t> id;  ///< epoch and sequence: one motion
  std::shared_ptr<const Motion> motion;        ///< map frame
  double radius_m;                             ///< circumscribed
  Braking braking;
  double mistimed_s = 0.0;  ///< it may be early or late by so much
};

/// Where the team-mates are according to their promises, so that the lidar does not take them for
/// walls.
class PeerTracks {
 public:
  struct Disc {
    Vector2 centre;
    double radius_m;
  };

  /// `margin_m` is added around a peer when beam ends are judged. Promises last heard of more than
  /// `timeout_s` before a beam are not relied on. Throws std::invalid_argument for a negative
  /// margin or a timeout that is not positive.
  PeerTracks(double margin_m, double timeout_s);

  /// The motions of all peers in reach as known at `stamp_s`, of each peer in order of time; peers
  /// that are absent are forgotten.
  void update(double stamp_s, const std::vector<PeerMotion>& peers);

  /// Where the peers are at time t [s], without margin. A peer follows its newest motion that has
  /// begun.
  std::vector<Disc> at(double t) const;

  /// Turns hits that lie on a peer into ignored ones; returns how many.
  int ignore_peers(std::vector<Beam>& beams) const;

 private:
  double margin_m_;
  double timeout_s_;
  double stamp_s_ = 0.0;
  std::map<std::string, std::vector<PeerMotion>> tracks_;  // oldest motion first
};

}  // namespace mocha
