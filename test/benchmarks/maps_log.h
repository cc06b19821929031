#pragma once

#include <istream>

#include "benchmarks/maps_building.h"

namespace mocha {

/// A map of cells of 5 cm from a lidar log in CARMEN's format (FLASER lines; their poses are
/// believed), with a drive from where it begins to the place of the log farthest from there. What
/// was not seen free counts as occupied, but the robot's own places, within 0.35 m, as free. Throws
/// std::invalid_argument for a log without scans.
Building building_of_log(std::istream& log);

}  // namespace mocha
