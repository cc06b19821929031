#include "topology/roadmaps/skeleton.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

namespace mocha {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kChordLoss = 0.02;         // of an arc's clearance
constexpr std::size_t kStraightEdges = 12;  // tried from start and from goal, nearest first

/// Start or goal, and the circle in whose cell it is.
struct Terminal {
  int node;
  Vector2 position;
  double clearance_m;
  int site;
};

/// A node on an arc.
struct Stop {
  double parameter;
  int node;
};

class Builder {
 public:
  Builder(const Skeleton& skeleton, const Vector2& start, const Vector2& goal,
          const SkeletonOptions& options)
      : skeleton_(skeleton),
        options_(options),
        start_(terminal(Roadmap<2>::kStart, start)),
        goal_(terminal(Roadmap<2>::kGoal, goal)) {
    const bool narrow =
        start_.clearance_m > 0.0 && start_.clearance_m < options.required_clearance_m;
    escape_clearance_m_ = narrow ? start_.clearance_m * (1.0 - 1e-6) : kInfinity;
  }

  Roadmap<2> run() {
    for (const Terminal& end : {start_, goal_}) add_node(end.position, end.clearance_m);
    for (const Skeleton::Vertex& vertex : skeleton_.vertices) {
      const bool allowed = is_allowed(vertex.clearance_m, vertex.position);
      node_of_.push_back(allowed ? add_node(vertex.position, vertex.clearance_m) : -1);
    }
    stops_.resize(skeleton_.arcs.size());
    for (const Terminal& end : {start_, goal_}) add_foot(end);
    for (std::size_t i = 0; i < skeleton_.arcs.size(); ++i) add_arc(skeleton_.arcs[i], stops_[i]);
    for (const Terminal& end : {start_, goal_}) add_straight_edges(end);
    add_straight_edge(start_, goal_.node);
    return std::move(roadmap_);
  }

 private:
  Terminal terminal(int node, const Vector2& p) const {
    Terminal end{node, p, kInfinity, -1};
    for (int i = 0; i < static_cast<int>(skeleton_.sites.size()); ++i) {
      const double gap_m = (p - skeleton_.sites[i].centre).norm() - skeleton_.sites[i].radius_m;
      if (gap_m < end.clearance_m) std::tie(end.clearance_m, end.site) = std::tie(gap_m, i);
    }
    return end;
  }

  int add_node(const Vector2& p, double clearance_m) {
    roadmap_.nodes.push_back({p, clearance_m});
    return static_cast<int>(roadmap_.nodes.size()) - 1;
  }

  bool is_near_start(const Vector2& p) const {
    return (p - start_.position).norm() <= options_.escape_radius_m;
  }

  bool is_allowed(double clearance_m, const Vector2& p) const {
    return clearance_m >= options_.required_clearance_m ||
           (clearance_m >= escape_clearance_m_ && is_near_start(p));
  }

  /// The least clearance along the line; nothing where it may not run.
  std::optional<double> straight_clearance_m(const Vector2& from, const Vector2& to) const {
    const double length_m = (to - from).norm();
    const Vector2 along = length_m > 0.0 ? Vector2((to - from) / length_m) : Vector2::Zero();
    double least_m = kInfinity;
    for (const Circle& site : skeleton_.sites) {
      const Vector2 offset = site.centre - from;
      const double foot_m = offset.dot(along);
      const double nearest_m = std::clamp(foot_m, 0.0, length_m);
      const double gap_m = (offset - nearest_m * along).norm() - site.radius_m;
      least_m = std::min(least_m, gap_m);
      if (gap_m >= options_.required_clearance_m) continue;
      if (gap_m < escape_clearance_m_) return std::nullopt;
      const double reach_m = site.radius_m + options_.required_clearance_m;
      const double off2 = (offset - foot_m * along).squaredNorm();
      const double half_m = std::sqrt(std::max(0.0, reach_m * reach_m - off2));
      for (const double end_m : {foot_m - half_m, foot_m + half_m}) {
        if (!is_near_start(from + std::clamp(end_m, 0.0, length_m) * along)) return std::nullopt;
      }
    }
    return least_m;
  }

  bool add_straight_edge(const Terminal& from, int to) {
    const Vector2& p = roadmap_.nodes[to].position;
    const std::optional<double> clearance_m = straight_clearance_m(from.position, p);
    if (clearance_m) {
      roadmap_.edges.push_back({from.node, to, {}, (p - from.position).norm(), *clearance_m});
    }
    return clearance_m.has_value();
  }

  /// Leads straight away from the nearest circle until another is as near: clearance grows all the
  /// way, so that from free space it always reaches an arc.
  void add_foot(const Terminal& end) {
    if (!(end.clearance_m > 0.0)) return;
    const Vector2 away = (end.position - skeleton_.sites[end.site].centre).normalized();
    double way_m = kInfinity;
    for (int i = 0; i < static_cast<int>(skeleton_.sites.size()); ++i) {
      const Vector2 offset = end.position - skeleton_.sites[i].centre;
      const double level_m = end.clearance_m + skeleton_.sites[i].radius_m;
      const double approach_m = level_m - offset.dot(away);
      if (i == end.site || !(approach_m > 0.0)) continue;
      const double squares = (offset.norm() - level_m) * (offset.norm() + level_m);
      way_m = std::min(way_m, 0.5 * squares / approach_m);
    }
    split_nearest_arc(end, end.position + way_m * away);
  }

  /// Among the arcs around the end's cell.
  void split_nearest_arc(const Terminal& end, const Vector2& foot) {
    double nearest_m = kInfinity;
    Stop stop;
    std::size_t which = 0;
    for (std::size_t i = 0; i < skeleton_.arcs.size(); ++i) {
      const Skeleton::Arc& arc = skeleton_.arcs[i];
      if (arc.sites[0] != end.site && arc.sites[1] != end.site) continue;
      const double t = std::clamp(arc.bisector.parameter(foot), arc.range[0], arc.range[1]);
      const double apart_m = (arc.bisector.at(t) - foot).norm();
      if (!(apart_m < nearest_m)) continue;
      nearest_m = apart_m;
      stop.parameter = t;
      which = i;
    }
    if (nearest_m == kInfinity) return;
    const Bisector& bisector = skeleton_.arcs[which].bisector;
    const Vector2 place = bisector.at(stop.parameter);
    stop.node = add_node(place, terminal(end.node, place).clearance_m);
    if (add_straight_edge(end, stop.node)) {
      stops_[which].push_back(stop);
    } else {
      roadmap_.nodes.pop_back();
    }
  }

  void add_arc(const Skeleton::Arc& arc, std::vector<Stop> stops) {
    for (int i = 0; i < 2; ++i) {
      if (arc.ends[i] >= 0) stops.push_back({arc.range[i], node_of_[arc.ends[i]]});
    }
    std::sort(stops.begin(), stops.end(),
              [](const Stop& a, const Stop& b) { return a.parameter < b.parameter; });
    for (std::size_t i = 1; i < stops.size(); ++i) add_piece(arc.bisector, stops[i - 1], stops[i]);
  }

  void add_piece(const Bisector& bisector, const Stop& from, const Stop& to) {
    if (from.node < 0 || to.node < 0) return;
    double clearance_m =
        std::min(roadmap_.nodes[from.node].clearance_m, roadmap_.nodes[to.node].clearance_m);
    if (from.parameter < 0.0 && to.parameter > 0.0) clearance_m = bisector.clearance_m(0.0);
    if (clearance_m < options_.required_clearance_m) {
      const double reach = bisector.reach(options_.required_clearance_m);
      for (const double t : {std::max(from.parameter, -reach), std::min(to.parameter, reach)}) {
        if (!is_allowed(clearance_m, bisector.at(t))) return;
      }
    }
    std::vector<Vector2> corners = bisector.corners(from.parameter, to.parameter, kChordLoss);
    double length_m = 0.0;
    Vector2 last = roadmap_.nodes[from.node].position;
    for (const Vector2& corner : corners) {
      length_m += (corner - last).norm();
      last = corner;
    }
    length_m += (roadmap_.nodes[to.node].position - last).norm();
    roadmap_.edges.push_back({from.node, to.node, std::move(corners), length_m, clearance_m});
  }

  /// To the vertices of the end's cell and of its neighbours.
  void add_straight_edges(const Terminal& end) {
    std::vector<bool> is_around(skeleton_.sites.size(), false);
    for (const Skeleton::Arc& arc : skeleton_.arcs) {
      if (arc.sites[0] == end.site || arc.sites[1] == end.site) {
        is_around[arc.sites[0]] = is_around[arc.sites[1]] = true;
      }
    }
    std::vector<std::pair<double, int>> nearest;
    for (const Skeleton::Arc& arc : skeleton_.arcs) {
      if (!is_around[arc.sites[0]] && !is_around[arc.sites[1]]) continue;
      for (const int vertex : arc.ends) {
        if (vertex < 0 || node_of_[vertex] < 0) continue;
        nearest.push_back(
            {(skeleton_.vertices[vertex].position - end.position).norm(), node_of_[vertex]});
      }
    }
    std::sort(nearest.begin(), nearest.end());
    nearest.erase(std::unique(nearest.begin(), nearest.end()), nearest.end());
    nearest.resize(std::min(nearest.size(), kStraightEdges));
    for (const auto& [apart_m, node] : nearest) add_straight_edge(end, node);
  }

  const Skeleton& skeleton_;
  const SkeletonOptions& options_;
  Terminal start_;
  Terminal goal_;
  double escape_clearance_m_;
  Roadmap<2> roadmap_;
  std::vector<int> node_of_;              // a vertex; -1 if it is too narrow
  std::vector<std::vector<Stop>> stops_;  // between the ends of each arc
};

}  // namespace

Roadmap<2> roadmap_on(const Skeleton& skeleton, const Vector2& start, const Vector2& goal,
                      const SkeletonOptions& options) {
  return Builder(skeleton, start, goal, options).run();
}

}  // namespace mocha
