#pragma once

#include <mocha_ugv/MapKeyframe.h>
#include <mocha_ugv/PoseGraph.h>

#include <vector>

#include "perception/sensor/scan_hits.h"

namespace mocha {

mocha_ugv::MapKeyframe to_message(const ScanHits& scan);

/// Throws std::invalid_argument for a scan that no lidar measures.
ScanHits from_message(const mocha_ugv::MapKeyframe& message);

/// The keyframes; header and loops stay as they are.
void to_message(const std::vector<Pose>& poses, mocha_ugv::PoseGraph& message);

/// The poses of the keyframes. Throws std::invalid_argument where one is not finite, or too far
/// away.
std::vector<Pose> poses_of(const mocha_ugv::PoseGraph& message);

}  // namespace mocha
