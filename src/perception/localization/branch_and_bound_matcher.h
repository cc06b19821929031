#pragma once

#include <cstddef>
#include <vector>

#include "perception/localization/grid_pyramid.h"
#include "perception/localization/likelihood_field.h"
#include "perception/sensor/scan_hits.h"

namespace mocha {

/// Where in a map a scan may have been taken, without any prior: branch and bound over all free
/// places and headings, so that no place better than those found has been overlooked.
class BranchAndBoundMatcher {
 public:
  static constexpr std::size_t kHits = 80;  ///< of the scan, at most
  static constexpr double kReach_m = 0.1;   ///< standard deviation of a hit's distance to its wall

  struct Place {
    Pose pose;     ///< of the robot, map frame, to within the spacing
    double score;  ///< mean over the hits of exp(-d^2 / (2 kReach_m^2)), d to the nearest wall
  };

  /// Looks at `budget` bounds of places before it gives up.
  BranchAndBoundMatcher(const LikelihoodField& walls, int budget);

  struct Result {
    std::vector<Place> places;  ///< best first; empty where no place is good enough
    bool complete = true;       ///< false: given up; there may be better places
    int squares = 0;            ///< that were looked at
  };

  Result find(const ScanHits& scan) const;

 private:
  int budget_;
  double spacing_m_;
  Vector2 origin_;
  GridPyramid likelihood_;  // 255 on a wall
  GridPyramid free_;        // 255 where the robot may stand
};

}  // namespace mocha
