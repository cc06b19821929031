#include "benchmarks/table2_world.h"

#include "benchmarks/benchmark_world.h"

namespace mocha {

Table2World table2_world(int seed) {
  constexpr double kGap_m = 1.0;
  std::mt19937 random(2000 + seed);
  Table2World world{{}, {0.0, 0.0}, {{{100.0, 100.0}, {100.0, 55.0}, {45.0, 81.0}}}};
  std::vector<Vector2> free(world.targets.begin(), world.targets.end());
  free.push_back(world.start);
  world.circles = scatter({Table2World::kSide_m, 50, 1.0, 4.0}, kGap_m, free, random);
  return world;
}

}  // namespace mocha
