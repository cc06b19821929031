#include "topology/grid_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <queue>

namespace mocha {
namespace {

/// Cost of being at a point, per metre; infinite where the robot's centre must not be.
class PointCost {
 public:
  PointCost(const DistanceField& field, const Vector2& start,
            const std::vector<BlockedDisc>& blocked, const GridPathRules& rules)
      : field_(field), start_(start), blocked_(blocked), rules_(rules) {
    start_clearance_m_ = field.sample(start).distance_m;
  }

  double at(const Vector2& p, double distance_m) const {
    if (distance_m < rules_.required_clearance_m && !may_escape(p, distance_m)) return kInfinity;
    for (const BlockedDisc& disc : blocked_) {
      const double apart = (p - disc.centre).norm();
      // Who already stands inside may leave, but not come closer.
      if (apart < disc.radius_m && apart < (start_ - disc.centre).norm() - 1e-6) return kInfinity;
    }
    const double lack = std::max(0.0, 1.0 - distance_m / rules_.preferred_clearance_m);
    return 1.0 + rules_.clearance_weight * lack * lack;
  }

  double at(const Vector2& p) const { return at(p, field_.sample(p).distance_m); }

  /// Of the straight line; infinite if it meets a forbidden place.
  double of_line(const Vector2& a, const Vector2& b) const {
    const double length = (b - a).norm();
    // Half a cell apart, as the middle of a cell may be closer than all of its corners.
    const int steps =
        std::max(1, static_cast<int>(std::ceil(2.0 * length / field_.resolution_m())));
    double sum = 0.0;
    for (int i = 0; i <= steps; ++i) {
      const double cost = at(a + (b - a) * (static_cast<double>(i) / steps));
      if (cost == kInfinity) return kInfinity;
      sum += (i == 0 || i == steps ? 0.5 : 1.0) * cost;
    }
    return sum * length / steps;
  }

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

 private:
  bool may_escape(const Vector2& p, double distance_m) const {
    return distance_m >= start_clearance_m_ - 1e-3 && distance_m > 0.0 &&
           (p - start_).norm() < rules_.escape_radius_m;
  }

  const DistanceField& field_;
  const Vector2 start_;
  const std::vector<BlockedDisc>& blocked_;
  const GridPathRules& rules_;
  double start_clearance_m_;
};

/// A* over every stride-th corner of the field.
class LatticeSearch {
 public:
  LatticeSearch(const DistanceField& field, const PointCost& cost, const GridPathRules& rules)
      : field_(field), cost_(cost), required_m_(rules.required_clearance_m) {
    stride_ = std::max(1, static_cast<int>(std::lround(rules.step_m / field.resolution_m())));
    columns_ = (field.columns() - 1) / stride_ + 1;
    rows_ = (field.rows() - 1) / stride_ + 1;
    step_m_ = stride_ * field.resolution_m();
  }

  /// Start, nodes between, goal; nothing if there is no way.
  std::vector<Vector2> run(const Vector2& start, const Vector2& goal) {
    const int from = entry_node(start);
    const int to = entry_node(goal);
    if (from < 0 || to < 0) return {};
    const std::size_t nodes = static_cast<std::size_t>(columns_) * rows_;
    best_.assign(nodes, std::numeric_limits<float>::infinity());
    parent_.assign(nodes, -1);
    best_[from] = 0.0f;
    parent_[from] = from;
    queue_.push({heuristic(from, to), from});
    while (!queue_.empty()) {
      const Entry entry = queue_.top();
      queue_.pop();
      if (entry.node == to) return trace(start, from, to, goal);
      if (entry.bound > best_[entry.node] + heuristic(entry.node, to) + 1e-4f) continue;
      expand(entry.node, to);
    }
    return {};
  }

 private:
  struct Entry {
    float bound;
    int node;
    bool operator<(const Entry& other) const { return bound > other.bound; }
  };

  /// The node around p to which the straight way is cheapest; -1 if all are blocked.
  int entry_node(const Vector2& p) const {
    const Vector2 at = (p - field_.origin()) / step_m_;
    int best = -1;
    double least = PointCost::kInfinity;
    for (int corner = 0; corner < 4; ++corner) {
      const int x = std::clamp(static_cast<int>(at.x()) + corner % 2, 0, columns_ - 1);
      const int y = std::clamp(static_cast<int>(at.y()) + corner / 2, 0, rows_ - 1);
      const int node = y * columns_ + x;
      const double cost = cost_.of_line(p, position(node));
      if (cost < least) {
        least = cost;
        best = node;
      }
    }
    return best;
  }

  Vector2 position(int node) const {
    return field_.corner(node % columns_ * stride_, node / columns_ * stride_);
  }

  float heuristic(int node, int to) const {
    const float dx = std::abs(node % columns_ - to % columns_);
    const float dy = std::abs(node / columns_ - to / columns_);
    const float octile = std::max(dx, dy) + 0.41421356f * std::min(dx, dy);
    return octile * static_cast<float>(step_m_) * 0.9999f;
  }

  void expand(int node, int to) {
    const int x = node % columns_;
    const int y = node / columns_;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int nx = x + dx;
        const int ny = y + dy;
        if ((dx == 0 && dy == 0) || nx < 0 || ny < 0 || nx >= columns_ || ny >= rows_) continue;
        const int next = ny * columns_ + nx;
        const double length = step_m_ * (dx != 0 && dy != 0 ? M_SQRT2 : 1.0);
        const double distance_m = field_.at_corner(nx * stride_, ny * stride_);
        const double here = cost_.at(position(next), distance_m);
        const float reached = best_[node] + static_cast<float>(length * here);
        if (!(reached < best_[next])) continue;
        // The middle of a step may be closer to obstacles than both of its ends.
        const bool roomy = distance_m >= required_m_ + length;
        if (!roomy && cost_.of_line(position(node), position(next)) == PointCost::kInfinity)
          continue;
        best_[next] = reached;
        parent_[next] = node;
        queue_.push({reached + heuristic(next, to), next});
      }
    }
  }

  std::vector<Vector2> trace(const Vector2& start, int from, int to, const Vector2& goal) const {
    std::vector<Vector2> points = {goal};
    for (int node = to; node != from; node = parent_[node]) points.push_back(position(node));
    points.push_back(position(from));
    points.push_back(start);
    std::reverse(points.begin(), points.end());
    return points;
  }

  const DistanceField& field_;
  const PointCost& cost_;
  double required_m_;
  int stride_;
  int columns_;
  int rows_;
  double step_m_;
  std::vector<float> best_;
  std::vector<int> parent_;
  std::priority_queue<Entry> queue_;
};

/// Replaces runs of points by straight lines wherever that is no dearer.
std::vector<Vector2> cut_corners(const std::vector<Vector2>& points, const PointCost& cost) {
  std::vector<double> steps(points.size(), 0.0);
  for (std::size_t i = 1; i < points.size(); ++i) steps[i] = cost.of_line(points[i - 1], points[i]);
  std::vector<Vector2> shorter = {points.front()};
  for (std::size_t from = 0; from + 1 < points.size();) {
    std::size_t to = from + 1;
    double along = steps[to];
    for (std::size_t next = to + 1; next < points.size(); ++next) {
      along += steps[next];
      const double straight = cost.of_line(points[from], points[next]);
      if (straight == PointCost::kInfinity || straight > along + 1e-6) break;
      to = next;
    }
    shorter.push_back(points[to]);
    from = to;
  }
  return shorter;
}

bool inside(const DistanceField& field, const Vector2& p) {
  const Vector2 at = (p - field.origin()) / field.resolution_m();
  return at.minCoeff() >= 0.0 && at.x() <= field.columns() - 1 && at.y() <= field.rows() - 1;
}

}  // namespace

GridPath find_grid_path(const DistanceField& field, const Vector2& start, const Vector2& goal,
                        const std::vector<BlockedDisc>& blocked, const GridPathRules& rules) {
  GridPath path;
  path.outcome = GridPath::Outcome::kStartBlocked;
  if (!inside(field, start)) return path;
  const PointCost cost(field, start, blocked, rules);
  if (cost.at(start) == PointCost::kInfinity) return path;
  if (!inside(field, goal) || cost.at(goal) == PointCost::kInfinity) {
    path.outcome = GridPath::Outcome::kGoalBlocked;
    return path;
  }
  path.outcome = GridPath::Outcome::kNoPath;
  if (cost.of_line(start, goal) < (goal - start).norm() * (1.0 + 1e-9)) {
    path.points = {start, goal};
  } else {
    const std::vector<Vector2> points = LatticeSearch(field, cost, rules).run(start, goal);
    if (points.empty()) return path;
    path.points = cut_corners(points, cost);
  }
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    path.cost += cost.of_line(path.points[i - 1], path.points[i]);
  }
  path.outcome = GridPath::Outcome::kFound;
  return path;
}

}  // namespace mocha
