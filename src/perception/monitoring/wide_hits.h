#pragma once

#include <vector>

#include "perception/sensor/beam.h"

namespace mocha {

/// The beams of a scan, in order, with the hits ignored that are on nothing wide: neighbouring hits
/// less than 0.35 m apart that together are less than 2 m across. People, and other things that are
/// not known to move yet, are not that wide; walls are.
std::vector<Beam> with_wide_hits_only(std::vector<Beam> beams);

}  // namespace mocha
