#include "planning/candidates/local_scene.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"

namespace mocha {
namespace {

TEST(LocalScene, ProofsAndSearchesSeeTheSameObstacles) {
  OccupancyGrid grid = free_grid({-2.0, -2.0}, {2.0, 2.0});
  fill_disc(grid, {1.0, 0.0}, 0.3, OccupancyGrid::kOccupied);
  const auto static_map = static_map_of(grid);
  const LocalScene scene = local_scene(static_map, nullptr);
  EXPECT_EQ(scene.obstacles.get(), &static_map->field());
  EXPECT_EQ(scene.static_map, static_map);
  EXPECT_FALSE(scene.unseen) << "nothing is promised there";
  EXPECT_TRUE(scene.peers.empty());
  EXPECT_TRUE(scene.confident.empty());
}

/// The field is the map's: it must not go with the caller's hold on the map.
TEST(LocalScene, KeepsTheMapAlive) {
  auto static_map = static_map_of(free_grid({-2.0, -2.0}, {2.0, 2.0}));
  const std::weak_ptr<const StaticMap> watched = static_map;
  auto scene = std::make_unique<LocalScene>(local_scene(std::move(static_map), nullptr));
  const auto obstacles = scene->obstacles;
  scene.reset();
  EXPECT_FALSE(watched.expired());
}

}  // namespace
}  // namespace mocha
