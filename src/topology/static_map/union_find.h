#pragma once

#include <algorithm>
#include <vector>

namespace mocha {

/// Numbers from 0, in disjoint sets that can be united. The smallest number stands for its set.
class UnionFind {
 public:
  /// Each number alone.
  explicit UnionFind(int count = 0) {
    while (size() < count) add();
  }

  int size() const { return static_cast<int>(parent_.size()); }

  /// The next number, alone.
  void add() { parent_.push_back(size()); }

  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void join(int a, int b) {
    const auto [low, high] = std::minmax({root(a), root(b)});
    parent_[high] = low;
  }

 private:
  std::vector<int> parent_;  // in the same set, not greater
};

}  // namespace mocha
