#pragma once

#include "perception/sensor/planar_scan.h"

namespace mocha {

/// The scan with less noise: the range of a hit becomes the mean over itself and its neighbours on
/// the same surface, as many on each side, at most 16, up to the first whose hit is more than
/// `reach_m` away. Fewer are taken where the outer ones lie behind the inner ones, as at an edge
/// that points to the lidar: a right-angled one moves by 7 mm at most, the rims of what stands out
/// of a wall by less than `reach_m` by half of that. What has no such neighbours on both sides
/// stays as it was measured. The first and the last beam of a scan all round are neighbours: so the
/// range there moves by half of what it changes during a sweep, less than half of `reach_m`.
PlanarScan smoothed(const PlanarScan& scan, double reach_m);

}  // namespace mocha
