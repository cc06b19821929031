#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "perception/localization/grid_pyramid.h"
#include "perception/localization/likelihood_field.h"
#include "perception/localization/scan_matcher.h"
#include "perception/localization/square_sums.h"
#include "perception/sensor/scan_hits.h"

namespace mocha {

/// What is searched: poses with positions and headings that near to those of the centre.
struct SearchWindow {
  Pose centre;
  double radius_m = std::numeric_limits<double>::infinity();
  double turn_rad = M_PI;  ///< to either side

  /// Three standard deviations around.
  static SearchWindow around(const PoseEstimate& base) {
    return {base.pose, 3.0 * base.sigma_m(), 3.0 * base.sigma_rad()};
  }
};

/// Where in a map a scan may have been taken: branch and bound over all free places and headings of
/// a window, so that no place better than those found has been overlooked.
class BranchAndBoundMatcher {
 public:
  static constexpr double kReach_m = 0.1;  ///< standard deviation of a hit's distance to its wall

  struct Options {
    int budget = 0;          ///< gives up after so many bounds of places
    std::size_t hits = 80;   ///< of the scan, at most; up to 257
    double min_score = 0.5;  ///< worse places are none
  };

  struct Place {
    Pose pose;     ///< of the robot, map frame, to within the spacing
    double score;  ///< mean over the hits of exp(-d^2 / (2 kReach_m^2)), d to the nearest wall
  };

  BranchAndBoundMatcher(const LikelihoodField& walls, const Options& options);

  struct Result {
    std::vector<Place> places;  ///< best first; empty where no place is good enough
    bool complete = true;       ///< false: given up; there may be better places
    int squares = 0;            ///< that were looked at
  };

  /// Searches everywhere, unless there is a window.
  Result find(const ScanHits& scan, const SearchWindow& window = {}) const;

 private:
  Options options_;
  double spacing_m_;
  Vector2 origin_;
  GridPyramid likelihood_;  // 255 on a wall
  SquareSums top_;          // of its coarsest level
  GridPyramid free_;        // 255 where the robot may stand
};

}  // namespace mocha
