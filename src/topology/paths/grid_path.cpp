#include "topology/paths/grid_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include "topology/static_map/lattice.h"

namespace mocha {
namespace {

/// Over a lattice that holds the corners of a map: A* to a goal, or Dijkstra's search for a place
/// that suits.
class LatticeSearch {
 public:
  using Suits = std::function<bool(const Vector2&)>;

  LatticeSearch(const StaticMap& static_map, const TravelCost& cost, double step_m,
                std::function<bool()> should_stop)
      : static_map_(static_map),
        cost_(cost),
        lattice_(static_map, step_m),
        should_stop_(std::move(should_stop)) {}

  bool stopped() const { return stopped_; }

  /// Start, nodes between, goal; nothing if there is no path.
  std::vector<Vector2> run(const Vector2& start, const Vector2& goal) {
    const int to = lattice_.entry(goal, cost_);
    if (to < 0) return {};
    std::vector<Vector2> points =
        search(start, to, nullptr, std::numeric_limits<double>::infinity());
    if (!points.empty()) points.push_back(goal);
    return points;
  }

  std::vector<Vector2> run(const Vector2& start, const Suits& suits, double most_m) {
    return search(start, kNowhere, suits, most_m);
  }

 private:
  static constexpr int kNowhere = -1;
  static constexpr int kBetweenStops = 1000;  // nodes

  struct Entry {
    float bound;
    int node;
    bool operator<(const Entry& other) const { return bound > other.bound; }
  };

  std::vector<Vector2> search(const Vector2& start, int to, const Suits& suits, double most_m) {
    const int from = lattice_.entry(start, cost_);
    if (from < 0) return {};
    best_.assign(lattice_.size(), std::numeric_limits<float>::infinity());
    parent_.assign(lattice_.size(), -1);
    best_[from] = 0.0f;
    parent_[from] = from;
    queue_.push({heuristic(from, to), from});
    for (int i = 1; !queue_.empty(); ++i) {
      stopped_ = i % kBetweenStops == 0 && should_stop_();
      if (stopped_) return {};
      const Entry entry = queue_.top();
      queue_.pop();
      if (entry.bound > most_m) return {};
      if (entry.bound > best_[entry.node] + heuristic(entry.node, to) + 1e-4f) continue;
      const bool there = suits ? suits(position(entry.node)) : entry.node == to;
      if (there) return trace(start, from, entry.node);
      expand(entry.node, to);
    }
    return {};
  }

  Vector2 position(int node) const { return lattice_.position(node); }

  float heuristic(int node, int to) const {
    if (to == kNowhere) return 0.0f;
    const float dx = std::abs(lattice_.column(node) - lattice_.column(to));
    const float dy = std::abs(lattice_.row(node) - lattice_.row(to));
    const float octile = std::max(dx, dy) + 0.41421356f * std::min(dx, dy);
    return octile * static_cast<float>(lattice_.step_m()) * 0.9999f;
  }

  void expand(int node, int to) {
    lattice_.visit_neighbours(node, [&](int next, double length) {
      if (!(best_[node] + static_cast<float>(length) < best_[next])) return;
      const double distance_m = static_map_.field().sample(position(next)).distance_m;
      const double here = cost_.at(position(next), distance_m);
      const float reached = best_[node] + static_cast<float>(length * here);
      if (!(reached < best_[next])) return;
      // The middle of a step may be closer to obstacles than both of its ends.
      const bool roomy = distance_m >= cost_.options().required_clearance_m + length;
      if (!roomy && cost_.of_line(position(node), position(next)) == TravelCost::kInfinity) return;
      best_[next] = reached;
      parent_[next] = node;
      queue_.push({reached + heuristic(next, to), next});
    });
  }

  std::vector<Vector2> trace(const Vector2& start, int from, int to) const {
    std::vector<Vector2> points;
    for (int node = to; node != from; node = parent_[node]) points.push_back(position(node));
    points.push_back(position(from));
    points.push_back(start);
    std::reverse(points.begin(), points.end());
    return points;
  }

  const StaticMap& static_map_;
  const TravelCost& cost_;
  const Lattice lattice_;
  const std::function<bool()> should_stop_;
  bool stopped_ = false;
  std::vector<float> best_;
  std::vector<int> parent_;
  std::priority_queue<Entry> queue_;
};

}  // namespace

GridPath find_nearest_place(const StaticMap& static_map, const Vector2& start,
                            const TravelCost& cost, double step_m, double most_m,
                            const LatticeSearch::Suits& suits) {
  GridPath path;
  path.outcome = GridPath::Outcome::kStartBlocked;
  if (!static_map.bounds().contains(start) || cost.at(start) == TravelCost::kInfinity) return path;
  path.points =
      suits(start)
          ? std::vector<Vector2>{start}
          : LatticeSearch(static_map, cost, step_m, [] { return false; }).run(start, suits, most_m);
  path.outcome = path.points.empty() ? GridPath::Outcome::kNoPath : GridPath::Outcome::kFound;
  return path;
}

GridPath find_grid_path(const StaticMap& static_map, const Vector2& start, const Vector2& goal,
                        const TravelCost& cost, double step_m,
                        const std::function<bool()>& should_stop) {
  GridPath path;
  path.outcome = GridPath::Outcome::kStartBlocked;
  if (!static_map.bounds().contains(start) || cost.at(start) == TravelCost::kInfinity) return path;
  path.outcome = GridPath::Outcome::kGoalBlocked;
  if (!static_map.bounds().contains(goal) || cost.at(goal) == TravelCost::kInfinity) return path;
  LatticeSearch search(static_map, cost, step_m, should_stop);
  path.points = search.run(start, goal);
  path.outcome = search.stopped()      ? GridPath::Outcome::kStopped
                 : path.points.empty() ? GridPath::Outcome::kNoPath
                                       : GridPath::Outcome::kFound;
  return path;
}

}  // namespace mocha
