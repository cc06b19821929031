#include "topology/roadmaps/roadmap_simplification.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "topology/paths/path_shortcutting.h"

namespace mocha {
namespace {

constexpr int kPushes = 3;          // of a corner off the obstacles
constexpr double kPushed_m = 0.02;  // beyond the clearance that is required
constexpr int kNeighbours = 8;      // of a node, that shortcuts are tried to

/// Merges the edges of a roadmap into longer ones.
class Contraction {
 public:
  explicit Contraction(const Roadmap<2>& roadmap)
      : roadmap_(roadmap), edges_of_(roadmap.nodes.size()), used_(roadmap.edges.size(), false) {
    for (std::size_t i = 0; i < roadmap.edges.size(); ++i) {
      const auto& edge = roadmap.edges[i];
      edges_of_[edge.from].push_back(static_cast<int>(i));
      edges_of_[edge.to].push_back(static_cast<int>(i));
    }
  }

  Roadmap<2> run() {
    leave_out_dead_ends();
    std::vector<int> number(roadmap_.nodes.size(), -1);
    for (std::size_t i = 0; i < roadmap_.nodes.size(); ++i) {
      if (!stays(static_cast<int>(i))) continue;
      number[i] = static_cast<int>(result_.nodes.size());
      result_.nodes.push_back(roadmap_.nodes[i]);
    }
    for (std::size_t i = 0; i < roadmap_.nodes.size(); ++i) {
      if (number[i] < 0) continue;
      for (const int edge : edges_of_[i]) {
        if (!used_[edge]) follow(static_cast<int>(i), edge, number);
      }
    }
    return std::move(result_);
  }

 private:
  static bool is_end(int node) { return node <= Roadmap<2>::kGoal; }

  bool stays(int node) const { return is_end(node) || edges_of_[node].size() > 2; }

  int other_end(int edge, int node) const {
    const auto& ends = roadmap_.edges[edge];
    return ends.from == node ? ends.to : ends.from;
  }

  void leave_out_dead_ends() {
    std::vector<int> ends;
    for (std::size_t i = 0; i < edges_of_.size(); ++i) ends.push_back(static_cast<int>(i));
    while (!ends.empty()) {
      const int node = ends.back();
      ends.pop_back();
      if (is_end(node) || edges_of_[node].size() != 1) continue;
      const int edge = edges_of_[node].front();
      const int next = other_end(edge, node);
      edges_of_[node].clear();
      auto& others = edges_of_[next];
      others.erase(std::find(others.begin(), others.end(), edge));
      ends.push_back(next);
    }
  }

  /// From a node that stays along an edge to the next one that stays.
  void follow(int from, int edge, const std::vector<int>& number) {
    Roadmap<2>::Edge merged{number[from], -1, {}, 0.0, roadmap_.edges[edge].clearance_m};
    std::vector<Vector2> between;
    for (int node = from;;) {
      used_[edge] = true;
      const auto& part = roadmap_.edges[edge];
      if (part.from == node) {
        between.insert(between.end(), part.between.begin(), part.between.end());
      } else {
        between.insert(between.end(), part.between.rbegin(), part.between.rend());
      }
      merged.length_m += part.length_m;
      merged.clearance_m = std::min(merged.clearance_m, part.clearance_m);
      node = other_end(edge, node);
      merged.to = number[node];
      if (merged.to >= 0) break;
      between.push_back(roadmap_.nodes[node].position);
      const auto& edges = edges_of_[node];
      edge = edges[0] == edge ? edges[1] : edges[0];
    }
    merged.between = std::move(between);
    if (merged.to != merged.from) result_.edges.push_back(std::move(merged));
  }

  const Roadmap<2>& roadmap_;
  std::vector<std::vector<int>> edges_of_;
  std::vector<bool> used_;
  Roadmap<2> result_;
};

}  // namespace

Vector2 pushed_off(Vector2 p, const TravelCost& cost) {
  const double required_m = cost.options().required_clearance_m;
  for (int i = 0; i < kPushes; ++i) {
    const auto nearest = cost.static_map().field().sample(p);
    const double lack_m = required_m + kPushed_m - nearest.distance_m;
    const bool escapes = nearest.distance_m < required_m && std::isfinite(cost.at(p));
    if (!(lack_m > 0.0) || escapes) break;
    p += lack_m * nearest.gradient;
  }
  return p;
}

void price(Roadmap<2>& roadmap, const TravelCost& cost) {
  for (std::size_t i = Roadmap<2>::kGoal + 1; i < roadmap.nodes.size(); ++i) {
    roadmap.nodes[i].position = pushed_off(roadmap.nodes[i].position, cost);
  }
  for (auto& edge : roadmap.edges) {
    std::vector<Vector2> line = {roadmap.nodes[edge.from].position};
    for (const Vector2& point : edge.between) line.push_back(pushed_off(point, cost));
    line.push_back(roadmap.nodes[edge.to].position);
    edge.length_m = cost_of(line, cost);
    edge.between = std::vector<Vector2>(line.begin() + 1, line.end() - 1);
  }
  const auto impossible = [](const auto& edge) { return !std::isfinite(edge.length_m); };
  roadmap.edges.erase(std::remove_if(roadmap.edges.begin(), roadmap.edges.end(), impossible),
                      roadmap.edges.end());
}

Roadmap<2> contracted(const Roadmap<2>& roadmap) {
  Roadmap<2> result = Contraction(roadmap).run();
  // Where a loop on one node was left out, that node may be a dead end now.
  for (std::size_t nodes = roadmap.nodes.size(); result.nodes.size() < nodes;) {
    nodes = result.nodes.size();
    result = Contraction(result).run();
  }
  return result;
}

void add_shortcuts(Roadmap<2>& roadmap, const TravelCost& cost) {
  const int nodes = static_cast<int>(roadmap.nodes.size());
  std::vector<std::pair<double, int>> others;
  std::vector<std::pair<int, int>> pairs;
  for (int i = 0; i < nodes; ++i) {
    const Vector2& from = roadmap.nodes[i].position;
    others.clear();
    for (int j = 0; j < nodes; ++j) {
      if (j != i) others.emplace_back((roadmap.nodes[j].position - from).squaredNorm(), j);
    }
    const std::size_t near = std::min<std::size_t>(kNeighbours, others.size());
    std::partial_sort(others.begin(), others.begin() + near, others.end());
    for (std::size_t k = 0; k < near; ++k) pairs.push_back(std::minmax(i, others[k].second));
  }
  // Nodes may be near each other both ways.
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::vector<double> costs_m(pairs.size());
  tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t k) {
    costs_m[k] = cost.of_line(roadmap.nodes[pairs[k].first].position,
                              roadmap.nodes[pairs[k].second].position);
  });
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (std::isfinite(costs_m[k]))
      roadmap.edges.push_back({pairs[k].first, pairs[k].second, {}, costs_m[k], 0.0});
  }
}

}  // namespace mocha
