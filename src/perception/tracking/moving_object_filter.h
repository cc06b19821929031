#pragma once

#include <vector>

#include "config/parameter_table.h"
#include "perception/mapping/occupancy_map.h"
#include "perception/tracking/detector.h"
#include "perception/tracking/obstacle_tracker.h"
#include "perception/tracking/prediction_errors.h"

namespace mocha {

struct MovingObjectFilterOptions {
  double map_tolerance_m;    ///< hits that near to a wall of the map are on it ...
  double map_tolerance_rad;  ///< ... and farther by so much times their range
  double cluster_gap_m;      ///< hits that near to each other are on one thing
  int cluster_points;        ///< least hits of a moving thing
  double cluster_extent_m;   ///< larger things do not move
  TrackerOptions tracker;

  /// From the parameters of the same names, without units.
  static MovingObjectFilterOptions from(const ParameterTable& values);
};

/// Parts the hits of planar scans into those on the map and those on moving things, and follows the
/// latter.
///
/// A hit has come if the map is sure to be free there, and neither a wall nor unseen space is near.
/// They are kept out of the map until their thing has had the time to leave its place; what leaves
/// it is kept out on, until it has stood for a while. What stands is mapped, and followed all the
/// same.
class MovingObjectFilter {
 public:
  /// Throws std::invalid_argument, naming the value and its range.
  explicit MovingObjectFilter(const MovingObjectFilterOptions& options);

  /// Takes the next scan before it enters the map: hits on moving things become ignored ones.
  void sort(std::vector<Beam>& beams, const OccupancyMap& map);

  /// What moves or looks like a person, and what may move as it has come to where the map was free,
  /// predicted to a time.
  std::vector<TrackedObstacle> things(double time_s) const;
  /// Of these, what the map does not hold: what to keep clear of.
  std::vector<TrackedObstacle> moving(double time_s) const;
  /// How far off predictions of these turn out to be.
  PredictionSpread spread() const { return errors_.spread(); }
  /// How many hits of the newest scan are on moving things.
  int moving_hits() const { return moving_hits_; }

  void clear();

 private:
  BeamIndices come_hits(const std::vector<Beam>& beams, const OccupancyMap& map,
                        const std::vector<TrackedObstacle>& known) const;

  MovingObjectFilterOptions options_;
  Detector detector_;
  ObstacleTracker tracker_;
  PredictionErrors errors_;
  int moving_hits_ = 0;
};

}  // namespace mocha
