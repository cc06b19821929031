#include "planning/candidates/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace mocha {
namespace {

TEST(InParallel, DoesEachOnceForAnyNumberOfThreads) {
  for (const int threads : {0, 1, 2, 7, 100}) {
    for (const std::size_t count : {0u, 1u, 3u, 1000u}) {
      std::vector<std::atomic<int>> times(count);
      in_parallel(count, threads, [&](std::size_t i) { ++times.at(i); });
      for (const auto& n : times) EXPECT_EQ(n, 1) << threads << " threads, " << count;
    }
  }
}

TEST(InParallel, OnOneThreadItKeepsTheOrder) {
  std::vector<std::size_t> order;
  in_parallel(50, 1, [&](std::size_t i) { order.push_back(i); });
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(order[i], i);
}

TEST(InParallel, WhatIsThrownComesOut) {
  const auto fails = [](std::size_t i) {
    if (i == 3) throw std::runtime_error("third");
  };
  EXPECT_THROW(in_parallel(8, 2, fails), std::runtime_error);
}

}  // namespace
}  // namespace mocha
