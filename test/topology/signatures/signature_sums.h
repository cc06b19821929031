#pragma once

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "topology/signatures/h_signature.h"

namespace mocha {

template <int D>
using Path = std::vector<Eigen::Matrix<double, D, 1>>;

inline double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline SignatureKey sum_of_keys(const Signature& signature) {
  SignatureKey key = 0;
  for (std::size_t r = 0; r < signature.size(); ++r)
    key += signature[r] * key_of(static_cast<int>(r));
  return key;
}

template <int D>
SignatureKey key_along(const Cuts<D>& cuts, const Path<D>& path) {
  SignatureKey key = 0;
  for (std::size_t i = 1; i < path.size(); ++i) key += key_of(cuts, path[i - 1], path[i]);
  return key;
}

/// Signatures and keys add up along the path, and turn their signs with it.
template <int D>
void expect_sums(const Cuts<D>& cuts, const Path<D>& path) {
  const Signature whole = signature_of(cuts, path);
  for (std::size_t cut = 0; cut < path.size(); ++cut) {
    const Signature first = signature_of(cuts, Path<D>(path.begin(), path.begin() + cut + 1));
    const Signature second = signature_of(cuts, Path<D>(path.begin() + cut, path.end()));
    for (std::size_t r = 0; r < whole.size(); ++r) EXPECT_EQ(first[r] + second[r], whole[r]);
    EXPECT_EQ(sum_of_keys(first) + sum_of_keys(second), sum_of_keys(whole));
  }
  const Signature back = signature_of(cuts, Path<D>(path.rbegin(), path.rend()));
  for (std::size_t r = 0; r < whole.size(); ++r) EXPECT_EQ(back[r], -whole[r]);
  EXPECT_EQ(sum_of_keys(whole) + sum_of_keys(back), 0u);
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Signature line = signature_of(cuts, Path<D>{path[i - 1], path[i]});
    EXPECT_EQ(key_of(cuts, path[i - 1], path[i]), sum_of_keys(line));
  }
  EXPECT_EQ(key_along(cuts, path), sum_of_keys(whole));
}

}  // namespace mocha
