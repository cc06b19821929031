#include "planning/passing/place_packing.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <queue>
#include <utility>

namespace mocha {
namespace {

constexpr int kMostRounds = 20;
constexpr double kMoreRoom_m = 0.01;  // for which a place moves

/// Points by square cells as wide as the distance that matters.
class Buckets {
 public:
  explicit Buckets(double width_m) : width_m_(width_m) {}

  void add(int number, const Vector2& place) { cells_[cell(place)].push_back({number, place}); }

  /// Calls visit(number) for all points closer to `place` than the width.
  template <typename Visit>
  void visit_near(const Vector2& place, const Visit& visit) const {
    const auto [column, row] = cell(place);
    for (std::int64_t y = row - 1; y <= row + 1; ++y) {
      for (std::int64_t x = column - 1; x <= column + 1; ++x) {
        const auto found = cells_.find({x, y});
        if (found == cells_.end()) continue;
        for (const auto& [number, other] : found->second) {
          if ((other - place).norm() < width_m_) visit(number);
        }
      }
    }
  }

 private:
  using Cell = std::pair<std::int64_t, std::int64_t>;
  Cell cell(const Vector2& place) const {
    return {std::llround(std::floor(place.x() / width_m_)),
            std::llround(std::floor(place.y() / width_m_))};
  }

  double width_m_;
  std::map<Cell, std::vector<std::pair<int, Vector2>>> cells_;
};

}  // namespace

std::vector<int> packed(const std::vector<Vector2>& candidates, const std::vector<Vector2>& fixed,
                        double apart_m) {
  const int count = static_cast<int>(candidates.size());
  Buckets buckets(apart_m);
  for (int i = 0; i < count; ++i) buckets.add(i, candidates[i]);
  std::vector<bool> open(count, true);
  for (const Vector2& place : fixed) buckets.visit_near(place, [&](int i) { open[i] = false; });
  std::vector<int> rivals(count, 0);
  using Entry = std::pair<int, int>;  // with so many rivals, then; the candidate
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> fewest_first;
  for (int i = 0; i < count; ++i) {
    if (!open[i]) continue;
    buckets.visit_near(candidates[i], [&](int j) { rivals[i] += open[j] && j != i; });
    fewest_first.emplace(rivals[i], i);
  }
  std::vector<int> chosen;
  while (!fewest_first.empty()) {
    const auto [then, next] = fewest_first.top();
    fewest_first.pop();
    if (!open[next] || then != rivals[next]) continue;
    chosen.push_back(next);
    open[next] = false;
    std::vector<int> closed;
    buckets.visit_near(candidates[next], [&](int i) {
      if (open[i]) closed.push_back(i);
    });
    for (const int i : closed) open[i] = false;
    for (const int i : closed) {
      buckets.visit_near(candidates[i], [&](int j) {
        if (open[j]) fewest_first.emplace(--rivals[j], j);
      });
    }
  }
  return chosen;
}

std::vector<int> settled(std::vector<int> chosen, const std::vector<Vector2>& candidates,
                         const std::vector<double>& room_m, const std::vector<Vector2>& fixed,
                         double apart_m, double step_m) {
  Buckets steps(step_m);
  for (int i = 0; i < static_cast<int>(candidates.size()); ++i) steps.add(i, candidates[i]);
  const auto least_room_m = [&](int candidate, int except) {
    double least_m = room_m[candidate];
    const auto heed = [&](const Vector2& other) {
      least_m = std::min(least_m, (other - candidates[candidate]).norm() - apart_m);
    };
    for (const Vector2& other : fixed) heed(other);
    for (const int other : chosen) {
      if (other != except) heed(candidates[other]);
    }
    return least_m;
  };
  bool goes_on = true;
  for (int round = 0; goes_on && round < kMostRounds; ++round) {
    goes_on = false;
    for (int& place : chosen) {
      int best = place;
      double most_m = least_room_m(place, place) + kMoreRoom_m;
      steps.visit_near(candidates[place], [&](int next) {
        const double next_m = least_room_m(next, place);
        if (!(next_m > most_m)) return;
        most_m = next_m;
        best = next;
      });
      goes_on = goes_on || best != place;
      place = best;
    }
  }
  return chosen;
}

}  // namespace mocha
