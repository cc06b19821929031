#pragma once

#include <vector>

#include "perception/tracking/detection.h"
#include "perception/tracking/legs.h"
#include "perception/tracking/obstacle_tracker.h"

namespace mocha {

struct DetectorOptions {
  double gap_m;     ///< hits that near to each other are on one thing
  int points;       ///< least hits of a thing
  double extent_m;  ///< larger things do not move
  double reach_m;   ///< hits that near to a known thing that stands, and is no person, are on it
};

/// Finds what may move among the hits of a scan: what has come to where the map was free, what is
/// known and stands, and what looks like legs. A lively thing moves, or is a person, who may stand.
/// Hits on surfaces that are too large to move make no thing.
class Detector {
 public:
  explicit Detector(const DetectorOptions& options) : options_(options) {}

  /// A thing and the hits on it, ascending.
  struct Thing {
    BeamIndices hits;
    Detection detection;
  };

  /// `came` are the hits where the map was free, ascending; `known` the things known before, at the
  /// time of the scan.
  std::vector<Thing> detect(const std::vector<Beam>& beams, const BeamIndices& came,
                            const std::vector<TrackedObstacle>& known) const;

 private:
  std::vector<bool> on_large_surfaces(const std::vector<ScanSegment>& segments,
                                      const std::vector<bool>& has_come) const;
  bool is_on_standing_person(const Beam& beam, const std::vector<TrackedObstacle>& lively) const;
  std::vector<BeamIndices> lively_things(const std::vector<Beam>& beams, const BeamIndices& hits,
                                         const std::vector<TrackedObstacle>& lively) const;
  std::vector<BeamIndices> still_things(const std::vector<Beam>& beams, const BeamIndices& hits,
                                        const std::vector<TrackedObstacle>& still) const;
  bool is_thing(const std::vector<Beam>& beams, const BeamIndices& group) const;
  bool is_in_reach(const Beam& beam, const TrackedObstacle& thing) const;
  bool is_one_thing(const std::vector<Beam>& beams, const BeamIndices& group) const;
  std::vector<BeamIndices> keep_to_reach(const std::vector<Beam>& beams,
                                         const TrackedObstacle& thing, BeamIndices& group) const;

  DetectorOptions options_;
};

}  // namespace mocha
