#pragma once

#include <cstdio>
#include <cstdlib>

#include "fuzz/oddities.h"

namespace mocha {

/// The main program `name` COUNT SEED of a fuzzer: COUNT inputs, in lives of `lifetime` each. A
/// Fuzzer is made with a seed; it has run(), taken() and refused().
template <typename Fuzzer>
int fuzz_lives(int argc, char** argv, const char* name, int lifetime) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s COUNT SEED\n", name);
    return 2;
  }
  int taken = 0;
  int refused = 0;
  for (int life = 0; life < std::atoi(argv[1]) / lifetime; ++life) {
    Fuzzer fuzzer(static_cast<unsigned>(std::atoi(argv[2]) + life));
    fuzzer.run(lifetime);
    taken += fuzzer.taken();
    refused += fuzzer.refused();
  }
  std::printf("%s: %d inputs were taken, %d refused\n", name, taken, refused);
  require(taken > refused / 2, "hardly anything was taken: the damage is too wild");
  require(refused > taken / 20, "hardly anything was refused: the damage is too tame");
  return 0;
}

}  // namespace mocha
