#pragma once

#include "perception/localization/likelihood_field.h"
#include "perception/sensor/scan_hits.h"
#include "world/occupancy_grid.h"

namespace mocha {

/// How a scan, seen from a pose, agrees with a map.
struct ScanFit {
  int on_wall = 0;  ///< hits near an occupied cell, with nothing occupied before them
  int in_free = 0;  ///< hits where the map knows that nothing stands: people, or the wrong place
  int behind = 0;   ///< hits that an occupied cell would have hidden
  int unknown = 0;  ///< hits of which the map says nothing

  int hits() const { return known() + unknown; }
  /// Those of which the map says anything.
  int known() const { return on_wall + in_free + behind; }
  /// Of these, the share that it explains; 0 without any.
  double quality() const { return known() == 0 ? 0.0 : static_cast<double>(on_wall) / known(); }
};

/// Judges `scan` as seen from `pose` (map frame). A hit is on a wall within `tolerance_m` of it.
ScanFit fit_of(const ScanHits& scan, const Pose& pose, const LikelihoodField& walls,
               double tolerance_m);

}  // namespace mocha
