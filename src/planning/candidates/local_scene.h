#pragma once

#include <memory>

#include "safety/scene.h"
#include "topology/static_map/static_map.h"

namespace mocha {

/// What is around a robot that promises and swerves, and the map that its paths are searched on.
struct LocalScene : Scene {
  std::shared_ptr<const StaticMap> static_map;
};

/// The scene of a map, without anything that moves; `unseen` may be null where nothing is promised.
LocalScene local_scene(std::shared_ptr<const StaticMap> static_map,
                       std::shared_ptr<const ObstacleField<2>> unseen);

}  // namespace mocha
