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

/// Whether a thing that is `now` at `centre` has left a place where it was seen before: none of it
/// is within kDepartureGap_m of what was hit then, and most of that is passed by beams, or hidden
/// by the thing itself that has come nearer. Walls of which a scan shows another part than the
/// scans before, and things that are believed in a slightly wrong place, have not.
bool has_left(const SeenPlace& place, const Detection& now, const Vector2& centre,
              const std::vector<Beam>& beams);

}  // namespace mocha
