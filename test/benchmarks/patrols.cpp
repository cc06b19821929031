#include "benchmarks/patrols.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace mocha {

Patrols::Patrols(std::vector<std::vector<Vector2>> places)
    : places_(std::move(places)), of_(places_.size()), next_(places_.size(), 1) {
  std::iota(of_.begin(), of_.end(), 0);
}

void Patrols::arrive(int robot) {
  const int patrol = of_[robot];
  next_[patrol] = (next_[patrol] + 1) % static_cast<int>(places_[patrol].size());
}

void Patrols::swap() { std::rotate(of_.begin(), of_.begin() + 1, of_.end()); }

}  // namespace mocha
