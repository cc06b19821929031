#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <nlohmann/json.hpp>

#include "world/world_file.h"

namespace mocha {

/// To four decimals.
inline double rounded(double value) { return std::round(1e4 * value) / 1e4; }

/// The main function of a program whose arguments are a world file, a seed, and a time [s]: prints
/// what `run` makes of them. Returns the exit status.
template <typename Run>
int run_on_world(int argc, char** argv, const Run& run) {
  try {
    if (argc != 4) throw std::runtime_error("usage: WORLD SEED SECONDS");
    const World world = load_world(argv[1], "config");
    const nlohmann::json result =
        run(world, std::strtoull(argv[2], nullptr, 10), std::atof(argv[3]));
    std::printf("%s\n", result.dump().c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}

}  // namespace mocha
