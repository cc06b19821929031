#pragma once

#include <vector>

#include "benchmarks/benchmark_world.h"

namespace mocha {

/// What is built, ten times as large: a wall with two windows, a ring that hangs free, and two
/// storeys; each with the shortest path that planning in space finds in its map.
std::vector<BenchmarkWorld<3>> built_worlds();

}  // namespace mocha
