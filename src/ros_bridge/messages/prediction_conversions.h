#pragma once

#include <mocha_ugv/PredictedObstacles.h>
#include <ros/time.h>

#include <string>
#include <vector>

#include "perception/tracking/obstacle_tracker.h"

namespace mocha {

/// Tracks predicted to `stamp`.
mocha_ugv::PredictedObstacles to_message(const std::vector<TrackedObstacle>& obstacles,
                                         const std::string& frame, ros::Time stamp);

}  // namespace mocha
