#pragma once

#include "benchmarks/fleet_run.h"
#include "world/obstacle.h"
#include "world/occupancy_grid.h"
#include "world/world_file.h"

namespace mocha {

/// A seeded scene, the same on every machine, and what stands in it.
struct FleetWorld {
  FleetScene scene;
  std::vector<Circle> circles;
};

/// The paper's five agents: they start at (0, 0), (2, 0), (0, 2), (4, 0) and (0, 4) and drive
/// through 20 m x 20 m of clutter to goals of their own, which lie together in the far corner.
FleetWorld five_agents(int seed);

/// Two to four robots on the rim of an open place of 6 m, each on its way to the other side, at
/// most two pillars between them.
FleetWorld crossing_robots(int seed);

/// What stands in a world, in cells of 5 cm.
OccupancyGrid map_of(const World& world);

/// The robots of a world that have a goal, all of which know its walls; how they look, when, and
/// what the network does follows the seed. Every robot is a rover.
FleetScene fleet_of(const World& world, int seed);

/// So many robots, each on 40 m^2 with a pillar, on their way to places 8 m away; each knows the
/// map around its own way.
FleetWorld spread_robots(int count, int seed);

}  // namespace mocha
