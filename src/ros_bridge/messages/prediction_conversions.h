#pragma once

#include <mocha_ugv/PredictedObstacles.h>
#include <ros/time.h>

#include <string>
#include <vector>

#include "perception/tracking/obstacle_tracker.h"
#include "world/moving/prediction.h"

namespace mocha {

/// Tracks predicted to `stamp`, and how far off predictions of them turn out to be.
mocha_ugv::PredictedObstacles to_message(const std::vector<TrackedObstacle>& obstacles,
                                         const PredictionSpread& spread, const std::string& frame,
                                         ros::Time stamp);

/// The latter, of normally distributed errors where the message says nothing. Throws
/// std::invalid_argument for what PredictionSpread::check() refuses.
PredictionSpread spread_from(const mocha_ugv::PredictedObstacles& message);

}  // namespace mocha
