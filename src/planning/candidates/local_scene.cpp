#include "planning/candidates/local_scene.h"

#include <utility>

namespace mocha {

LocalScene local_scene(std::shared_ptr<const StaticMap> static_map,
                       std::shared_ptr<const ObstacleField<2>> unseen) {
  LocalScene scene;
  scene.obstacles = std::shared_ptr<const ObstacleField<2>>(static_map, &static_map->field());
  scene.unseen = std::move(unseen);
  scene.static_map = std::move(static_map);
  return scene;
}

}  // namespace mocha
