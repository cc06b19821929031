#pragma once

#include <cstddef>
#include <vector>

#include "perception/max_pyramid.h"
#include "perception/scan_hits.h"
#include "perception/wall_field.h"

namespace mocha {

struct PlaceSearchOptions {
  double spacing_m = 0.05;  ///< of the places looked at; not below the map's cells
  double yaw_step_rad = 0.026;
  double reach_m = 0.1;    ///< standard deviation of a hit's distance to its wall
  std::size_t hits = 80;   ///< of the scan, at most
  double min_score = 0.5;  ///< worse places are none
  double rivalry = 0.15;   ///< places so much worse than the best are found as well
  double apart_m = 0.5;    ///< of places so near to each other, and so alike in heading, the best
  double apart_rad = 0.35;
  std::size_t most_places = 16;
  int most_squares = 2000000;  ///< looked at before the search is given up
};

/// Where in a map a scan may have been taken, without any prior: branch and bound over all free
/// places and headings, so that no place better than those found has been overlooked.
class PlaceSearch {
 public:
  struct Place {
    Pose pose;     ///< of the robot, map frame, to within the spacing
    double score;  ///< mean over the hits of exp(-d^2 / (2 reach^2)), d to the nearest wall
  };

  PlaceSearch(const WallField& walls, const PlaceSearchOptions& options);

  struct Result {
    std::vector<Place> places;  ///< best first; empty where no place is good enough
    bool complete = true;       ///< false: given up; there may be better places
    int squares = 0;            ///< that were looked at
  };

  Result find(const ScanHits& scan) const;

 private:
  PlaceSearchOptions options_;
  double spacing_m_;
  Vector2 origin_;
  MaxPyramid likelihood_;  // 255 on a wall
  MaxPyramid free_;        // 255 where the robot may stand
};

}  // namespace mocha
