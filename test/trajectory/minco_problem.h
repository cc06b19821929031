#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "trajectory/minco.h"

namespace mocha::test {

/// The combinations of dimension and smoothness for typed tests.
template <int Dimension, int Smoothness>
struct Case {
  static constexpr int D = Dimension;
  static constexpr int S = Smoothness;
};
using AllCases =
    ::testing::Types<Case<2, 2>, Case<2, 3>, Case<2, 4>, Case<3, 2>, Case<3, 3>, Case<3, 4>>;

/// A random curve to solve for: M pieces whose durations are spread evenly in their logarithm.
template <int D, int S>
struct Problem {
  using M = Minco<D, S>;
  typename M::State start;
  typename M::State end;
  typename M::Knots knots;
  Eigen::VectorXd durations;

  Problem(int pieces, int seed, double shortest_s = 0.3, double longest_s = 2.0)
      : knots(D, pieces - 1), durations(pieces) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> logarithm(std::log(shortest_s), std::log(longest_s));
    for (auto& x : start.reshaped()) x = normal(random);
    for (auto& x : end.reshaped()) x = normal(random);
    for (auto& x : knots.reshaped()) x = 3.0 * normal(random);
    for (auto& x : durations) x = std::exp(logarithm(random));
  }

  int pieces() const { return static_cast<int>(durations.size()); }

  M solved() const {
    M minco;
    minco.resize(pieces());
    minco.solve(start, end, knots, durations);
    return minco;
  }
};

}  // namespace mocha::test
