#pragma once

#include <optional>

#include "perception/sensor/planar_scan.h"

namespace mocha {

/// The standard deviation of a scan's ranges [m], from how its nearer hits scatter about the
/// straight lines through their neighbours: the median, which edges and what is not straight change
/// little. Nothing for a scan with too few such hits.
std::optional<double> range_noise_m(const PlanarScan& scan);

}  // namespace mocha
