#include "topology/paths/narrowest_place.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <vector>

#include "topology/paths/lattice.h"

namespace mocha {
namespace {

constexpr double kWidest_m = 10.0;  // more is not told apart
constexpr double kContact_m = 1e-3;
constexpr int kBetweenStops = 1000;  // nodes

/// Dijkstra's search for the way whose least clearance is the largest.
class WidestWay {
 public:
  WidestWay(const StaticMap& static_map, const Vector2& start, const Vector2& goal, double step_m,
            double free_radius_m)
      : field_(static_map.field()),
        lattice_(static_map, step_m),
        start_(start),
        goal_(goal),
        free_radius_m_(free_radius_m) {}

  /// Where its clearance is least.
  std::optional<Vector2> bottleneck(const std::function<bool()>& should_stop) {
    const int from = lattice_.nearest(start_);
    const int to = lattice_.nearest(goal_);
    best_m_.assign(lattice_.size(), 0.0f);
    narrowest_.assign(lattice_.size(), from);
    best_m_[from] = static_cast<float>(kWidest_m);
    queue_.push({best_m_[from], from});
    for (int i = 1; !queue_.empty(); ++i) {
      if (i % kBetweenStops == 0 && should_stop()) break;
      const Entry entry = queue_.top();
      queue_.pop();
      if (entry.clearance_m < best_m_[entry.node]) continue;
      if (entry.node == to) return lattice_.position(narrowest_[to]);
      lattice_.visit_neighbours(entry.node, [&](int next, double) { reach(next, entry.node); });
    }
    return std::nullopt;
  }

 private:
  struct Entry {
    float clearance_m;
    int node;
    bool operator<(const Entry& other) const { return clearance_m < other.clearance_m; }
  };

  void reach(int next, int from) {
    const Vector2 place = lattice_.position(next);
    const Vector2 middle = 0.5 * (place + lattice_.position(from));
    const double least_m = std::min(clearance_m(place), clearance_m(middle));
    const float reached_m = static_cast<float>(std::min<double>(best_m_[from], least_m));
    if (!(reached_m > best_m_[next])) return;
    best_m_[next] = reached_m;
    narrowest_[next] = least_m < best_m_[from] ? next : narrowest_[from];
    queue_.push({reached_m, next});
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
  std::vector<float> best_m_;   // clearance of the widest way there
  std::vector<int> narrowest_;  // node of that way
  std::priority_queue<Entry> queue_;
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
                                           const Vector2& goal, double step_m,
                                           double free_radius_m,
                                           const std::function<bool()>& should_stop) {
  const auto place =
      WidestWay(static_map, start, goal, step_m, free_radius_m).bottleneck(should_stop);
  if (!place) return std::nullopt;
  return NarrowPlace{*place, width_m(static_map.field(), *place)};
}

}  // namespace mocha
