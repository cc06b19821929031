#include "topology/paths/narrowest_place.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "topology/static_map/lattice.h"

namespace mocha {
namespace {

constexpr double kWidest_m = 10.0;  // more is not told apart
constexpr double kContact_m = 1e-3;

/// Floods a lattice from the roomiest places down, until start and goal are in one pool.
class WidestWay {
 public:
  WidestWay(const StaticMap& static_map, const Vector2& start, const Vector2& goal, double step_m,
            double free_radius_m)
      : field_(static_map.field()),
        lattice_(static_map, step_m),
        start_(start),
        goal_(goal),
        free_radius_m_(free_radius_m),
        clearance_m_(lattice_.size()),
        pool_(lattice_.size(), kDry) {}

  /// Where its clearance is least.
  std::optional<Vector2> bottleneck(const std::function<bool()>& should_stop) {
    measure();
    const int from = lattice_.nearest(start_);
    const int to = lattice_.nearest(goal_);
    for (int level = kLevels - 1; level >= 0; --level) {
      if (should_stop()) break;
      for (int i = first_[level]; i < first_[level + 1]; ++i) {
        flood(order_[i]);
        if (pool_[from] != kDry && pool_[to] != kDry && pool_of(from) == pool_of(to))
          return lattice_.position(order_[i]);
      }
    }
    return std::nullopt;
  }

 private:
  static constexpr int kDry = -1;
  static constexpr int kLevels = 20000;  // of clearance up to the widest, half a millimetre apart

  /// The places in the order of their clearance.
  void measure() {
    const int count = static_cast<int>(lattice_.size());
    tbb::parallel_for(0, count, [&](int node) {
      clearance_m_[node] = static_cast<float>(clearance_m(lattice_.position(node)));
    });
    first_.assign(kLevels + 1, 0);
    for (const float each_m : clearance_m_) {
      if (each_m > 0.0f) ++first_[level_of(each_m) + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    order_.resize(first_.back());
    std::vector<int> next(first_.begin(), first_.end() - 1);
    for (int node = 0; node < count; ++node) {
      if (clearance_m_[node] > 0.0f) order_[next[level_of(clearance_m_[node])]++] = node;
    }
  }

  static int level_of(float clearance_m) {
    return std::min(kLevels - 1, static_cast<int>(clearance_m / kWidest_m * kLevels));
  }

  void flood(int node) {
    pool_[node] = node;
    lattice_.visit_neighbours(node, [&](int next, double) {
      if (pool_[next] != kDry) pool_[pool_of(next)] = pool_of(node);
    });
  }

  int pool_of(int node) {
    while (pool_[node] != node) node = pool_[node] = pool_[pool_[node]];
    return node;
  }

  double clearance_m(const Vector2& place) const {
    const double distance_m = std::min(field_.sample(place).distance_m, kWidest_m);
    const bool is_free = distance_m > 0.0 && ((place - start_).norm() < free_radius_m_ ||
                                              (place - goal_).norm() < free_radius_m_);
    return is_free ? kWidest_m : distance_m;
  }

  const ObstacleField<2>& field_;
  const Lattice lattice_;
  const Vector2 start_;
  const Vector2 goal_;
  const double free_radius_m_;
  std::vector<float> clearance_m_;  // of each place
  std::vector<int> order_;          // places, by level
  std::vector<int> first_;          // of each level, and one more
  std::vector<int> pool_;           // of each place: another one of its pool, or itself
};

/// How far it is from a place to a surface in a direction, at most kWidest_m.
double ray_m(const ObstacleField<2>& field, const Vector2& place, const Vector2& direction) {
  double length_m = 0.0;
  while (length_m < kWidest_m) {
    const double room_m = field.sample(place + length_m * direction).distance_m;
    if (room_m < kContact_m) break;
    length_m += room_m;
  }
  return length_m;
}

/// From one surface to the one across, where that is the least.
double width_m(const ObstacleField<2>& field, const Vector2& place) {
  constexpr int kDirections = 32;
  double least_m = 2.0 * kWidest_m;
  for (int i = 0; i < kDirections; ++i) {
    const double angle_rad = M_PI * i / kDirections;
    const Vector2 direction(std::cos(angle_rad), std::sin(angle_rad));
    least_m = std::min(least_m, ray_m(field, place, direction) + ray_m(field, place, -direction));
  }
  return least_m;
}

}  // namespace

std::optional<NarrowPlace> narrowest_place(const StaticMap& static_map, const Vector2& start,
                                           const Vector2& goal, double step_m, double free_radius_m,
                                           const std::function<bool()>& should_stop) {
  const auto place =
      WidestWay(static_map, start, goal, step_m, free_radius_m).bottleneck(should_stop);
  if (!place) return std::nullopt;
  return NarrowPlace{*place, width_m(static_map.field(), *place)};
}

}  // namespace mocha
