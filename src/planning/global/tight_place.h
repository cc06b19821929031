#pragma once

#include <functional>
#include <vector>

#include "safety/leaving.h"
#include "trajectory/motion.h"

namespace mocha {

/// A stretch of a way out: a drive along an arc, or a turn in place.
struct Stretch {
  double length_m;  ///< negative: backward; 0: a turn in place
  double turn_rad;  ///< by how much the heading changes
};

/// Where a stretch that begins at `pose` leads after a share of it, from 0 to 1.
Pose along(const Pose& pose, const Stretch& stretch, double share);

/// A search for a way out of where a robot can neither turn round nor set off: its pose, its body
/// and what is around. Map frame.
struct TightPlace {
  Pose start;
  double reach_m;   ///< of the body about the base
  double margin_m;  ///< that the body keeps
  Leaving leaving;  ///< where it has less at first
  bool can_reverse = true;
  /// How far the body is from what is around [m], never overstated; negative inside.
  std::function<double(const Pose&)> gap_m;
  /// Whether the way out ends there.
  std::function<bool(const Pose&)> is_out;
  Vector2 exit;  ///< near which it ends: a hint for the search
};

/// A way out, or an empty list where none is found with `max_expansions` places looked at, twice at
/// most.
///
/// An A* over drives along arcs, forward and backward, and turns in place, whose places keep their
/// true pose (hybrid A*, Dolgov et al. 2010). It looks for few stretches and little way, not for
/// the least.
std::vector<Stretch> find_way_out(const TightPlace& tight, int max_expansions);

}  // namespace mocha
