#pragma once

#include <map>
#include <vector>

#include "perception/tracking/fading_quantiles.h"
#include "perception/tracking/obstacle_tracker.h"
#include "world/moving/prediction.h"

namespace mocha {

/// Learns from what becomes of predictions how far off they are: at constant velocity, what is seen
/// is held against what was predicted of it 0.5, 1 and 2 s before, in the deviations predicted
/// then. So discs of a confidence hold the things just so often, whatever these do: adaptive
/// conformal prediction.
///
/// Reference: Gibbs and Candes, Adaptive Conformal Inference Under Distribution Shift, 2021; Dixit
/// et al., Adaptive Conformal Prediction for Motion Planning among Dynamic Agents, 2023.
class PredictionErrors {
 public:
  PredictionErrors();

  /// What is known to move at the time of a scan, of several scans in order of time.
  void update(const std::vector<TrackedObstacle>& things);

  PredictionSpread spread() const;

  /// Forgets the predictions, not what was learnt from them.
  void forget() { pending_.clear(); }

 private:
  /// Made of one thing at one time.
  struct Prediction {
    TrackedObstacle thing;
    PredictedDeviation deviation;
    std::size_t next = 0;   ///< the time ahead that it reaches next
    double ahead_s = 0.0;   ///< when it was last held against what was seen ...
    double off = 0.0;       ///< ... and how far off it was, in deviations
    double farthest = 0.0;  ///< the most so far
  };

  void compare(Prediction& prediction, const TrackedObstacle& seen);

  std::vector<FadingQuantiles> at_;  // of the times ahead
  std::vector<FadingQuantiles> throughout_;
  std::map<std::uint32_t, std::vector<Prediction>> pending_;  // of what has that number
};

}  // namespace mocha
