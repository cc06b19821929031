#pragma once

#include <vector>

#include "perception/tracking/scan_segments.h"

namespace mocha {

/// Hits on what looks like the legs of one person, or like one of them.
struct LegHits {
  BeamIndices hits;  ///< ascending
  int legs;          ///< 1 or 2
};

/// Legs are narrow segments that stand free. Two as far apart as those of a person may be are a
/// pair, the closest first; each of the others is alone.
std::vector<LegHits> find_legs(const std::vector<Beam>& beams,
                               const std::vector<ScanSegment>& segments);

}  // namespace mocha
