#pragma once

#include <vector>

#include "perception/tracking/detection.h"

namespace mocha {

/// Where a thing was seen, and what of it.
struct SeenPlace {
  Vector2 centre;             ///< [m]
  std::vector<Vector2> hits;  ///< [m]
};

/// What is so near to what was hit before may be on the same thing, at the same place.
constexpr double kDepartureGap_m = 0.2;

/// What became of a thing that was seen at a place before.
enum class Departure {
  kNone,  ///< it is still there, or something is
  kLeft,  ///< none of it is within kDepartureGap_m of what was hit then, and most of that is passed
          ///< by beams, or hidden by the thing itself that has come nearer
  kUntold,  ///< none of it is near, but nothing shows what is at the place now
};

/// Returns what became of a thing that is `now` at `centre`. Walls of which a scan shows another
/// part than the scans before, and things that are believed in a slightly wrong place, have not
/// left; where the part before is out of sight, that is untold.
Departure departure(const SeenPlace& place, const Detection& now, const Vector2& centre,
                    const std::vector<Beam>& beams);

}  // namespace mocha
