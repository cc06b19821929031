#pragma once

#include <vector>

#include "perception/tracking/hit_clusters.h"

namespace mocha {

/// Hits of neighbouring beams, each near to the next: what a scan shows of one surface.
struct ScanSegment {
  BeamIndices hits;  ///< in the order of the sweep; may go on from its last beam to its first
  double width_m;    ///< between its ends, with half of what is between two beams beyond each
  bool stands_free;  ///< what is seen on either side is clearly farther away

  /// The end of its middle beam.
  Vector2 middle(const std::vector<Beam>& beams) const;
};

/// The angle between neighbouring beams, the median: beams may be missing.
double beam_spacing_rad(const std::vector<Beam>& beams);

/// Of the beams of one sweep, in its order. Two hits are on one surface if they are as near to each
/// other as noise and the slant of a surface explain: a surface seen at less than about 10 degrees
/// comes apart (Borges and Aldon, "Line extraction in 2D range images for mobile robotics", 2004).
std::vector<ScanSegment> scan_segments(const std::vector<Beam>& beams);

}  // namespace mocha
