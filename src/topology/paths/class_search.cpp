#include "topology/paths/class_search.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <stdexcept>
#include <string>
#include <unordered_set>
#include <utility>

namespace mocha {
namespace {

constexpr int kNone = -1;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-9;  // of sums of the same lengths in another order
constexpr int kSignatures = 4;      // of one node that are looked at, for each result

/// One direction of an edge, without its shape.
struct Arc {
  int to;
  int edge;
  double length_m;
  SignatureKey key;
};
using Arcs = std::vector<std::vector<Arc>>;  // of each node

template <int D>
SignatureKey key_along(const Cuts<D>& cuts, const Roadmap<D>& roadmap,
                       const typename Roadmap<D>::Edge& edge) {
  SignatureKey key = 0;
  typename Roadmap<D>::Point last = roadmap.nodes[edge.from].position;
  for (const auto& point : edge.between) {
    key += key_of<D>(cuts, last, point);
    last = point;
  }
  return key + key_of<D>(cuts, last, roadmap.nodes[edge.to].position);
}

template <int D>
Arcs arcs_of(const Roadmap<D>& roadmap, const Cuts<D>& cuts) {
  Arcs arcs(roadmap.nodes.size());
  for (std::size_t i = 0; i < roadmap.edges.size(); ++i) {
    const auto& edge = roadmap.edges[i];
    const SignatureKey key = key_along(cuts, roadmap, edge);
    arcs[edge.from].push_back({edge.to, static_cast<int>(i), edge.length_m, key});
    arcs[edge.to].push_back({edge.from, static_cast<int>(i), edge.length_m, SignatureKey(0) - key});
  }
  return arcs;
}

template <int D>
Arcs arcs_of(const Roadmap<D>& roadmap, const SampledSpace<D>& space) {
  Arcs arcs(roadmap.nodes.size());
  const auto add = [&](int from, int to, std::size_t edge) {
    const auto& p = roadmap.nodes[from].position;
    const auto& q = roadmap.nodes[to].position;
    if (!space.in_order(p, q)) return;
    const double length_m = roadmap.edges[edge].length_m;
    arcs[from].push_back({to, static_cast<int>(edge), length_m, space.key(p, q)});
  };
  for (std::size_t i = 0; i < roadmap.edges.size(); ++i) {
    add(roadmap.edges[i].from, roadmap.edges[i].to, i);
    add(roadmap.edges[i].to, roadmap.edges[i].from, i);
  }
  return arcs;
}

/// The arcs that lead to each node; only their ends and lengths.
Arcs reversed(const Arcs& arcs) {
  Arcs back(arcs.size());
  for (std::size_t from = 0; from < arcs.size(); ++from) {
    for (const Arc& arc : arcs[from])
      back[arc.to].push_back({static_cast<int>(from), arc.edge, arc.length_m, 0});
  }
  return back;
}

/// Shortest distance of every node to `goal`.
std::vector<double> distances_to(int goal, const Arcs& arcs) {
  const Arcs back = reversed(arcs);
  std::vector<double> distance_m(arcs.size(), kInfinity);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
  distance_m[goal] = 0.0;
  queue.push({0.0, goal});
  while (!queue.empty()) {
    const auto [reached_m, node] = queue.top();
    queue.pop();
    if (reached_m > distance_m[node]) continue;
    for (const Arc& arc : back[node]) {
      const double next_m = reached_m + arc.length_m;
      if (next_m >= distance_m[arc.to]) continue;
      distance_m[arc.to] = next_m;
      queue.push({next_m, arc.to});
    }
  }
  return distance_m;
}

/// The augmented search. Steps form a tree; a path is named by its last step.
class Search {
 public:
  struct Step {
    int node;
    int before;  // step
    int edge;
    SignatureKey key;
    double length_m;
  };

  Search(const Arcs& arcs, std::vector<double> to_goal_m, const ClassSearchOptions& options)
      : arcs_(arcs),
        to_goal_m_(std::move(to_goal_m)),
        options_(options),
        longest_m_((1.0 + kRounding) * options.longest_ratio * to_goal_m_[Roadmap<2>::kStart]),
        most_signatures_(static_cast<std::size_t>(kSignatures) * options.classes),
        seen_(arcs.size()) {}

  /// The last steps of the paths found.
  std::vector<int> run() {
    std::vector<int> found;
    if (to_goal_m_[Roadmap<2>::kStart] == kInfinity) return found;
    push({Roadmap<2>::kStart, kNone, kNone, 0, 0.0});
    while (!queue_.empty() && static_cast<int>(found.size()) < options_.classes) {
      const int current = queue_.top().second;
      queue_.pop();
      const Step step = steps_[current];
      auto& seen = seen_[step.node];
      if (seen.size() >= most_signatures_ || !seen.insert(step.key).second) continue;
      if (step.node == Roadmap<2>::kGoal) {
        found.push_back(current);
        continue;
      }
      for (const Arc& arc : arcs_[step.node]) {
        if (visits(current, arc.to)) continue;
        push({arc.to, current, arc.edge, step.key + arc.key, step.length_m + arc.length_m});
      }
    }
    return found;
  }

  const Step& step(int index) const { return steps_[index]; }

 private:
  void push(const Step& step) {
    const double bound_m = step.length_m + to_goal_m_[step.node];
    if (bound_m > longest_m_ || seen_[step.node].count(step.key) > 0) return;
    queue_.push({bound_m, static_cast<int>(steps_.size())});
    steps_.push_back(step);
  }

  bool visits(int last, int node) const {
    for (int i = last; i != kNone; i = steps_[i].before) {
      if (steps_[i].node == node) return true;
    }
    return false;
  }

  const Arcs& arcs_;
  const std::vector<double> to_goal_m_;
  const ClassSearchOptions options_;
  const double longest_m_;
  const std::size_t most_signatures_;
  std::vector<Step> steps_;
  std::vector<std::unordered_set<SignatureKey>> seen_;  // of each node
  using Entry = std::pair<double, int>;                 // bound and step; ties in order of age
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue_;
};

template <int D>
ClassPath<D> trace(const Search& search, int last, const Roadmap<D>& roadmap) {
  ClassPath<D> path{{}, search.step(last).length_m};
  for (int i = last; i != kNone; i = search.step(i).before) {
    const Search::Step& step = search.step(i);
    path.points.push_back(roadmap.nodes[step.node].position);
    if (step.edge == kNone) continue;
    const auto& edge = roadmap.edges[step.edge];
    if (edge.to == step.node) {
      path.points.insert(path.points.end(), edge.between.rbegin(), edge.between.rend());
    } else {
      path.points.insert(path.points.end(), edge.between.begin(), edge.between.end());
    }
  }
  std::reverse(path.points.begin(), path.points.end());
  return path;
}

void check(const ClassSearchOptions& options) {
  if (options.classes < 1) {
    throw std::invalid_argument("classes = " + std::to_string(options.classes) + ", at least 1");
  }
  if (!(options.longest_ratio >= 1.0)) {
    throw std::invalid_argument("longest_ratio = " + std::to_string(options.longest_ratio) +
                                ", at least 1");
  }
}

/// `classes`: the cuts, or the space.
template <int D, typename Classes>
std::vector<ClassPath<D>> search(const Roadmap<D>& roadmap, const Classes& classes,
                                 const ClassSearchOptions& options) {
  check(options);
  const Arcs arcs = arcs_of(roadmap, classes);
  Search search(arcs, distances_to(Roadmap<D>::kGoal, arcs), options);
  std::vector<ClassPath<D>> paths;
  for (const int last : search.run()) paths.push_back(trace(search, last, roadmap));
  return paths;
}

}  // namespace

template <int D>
std::vector<ClassPath<D>> shortest_classes(const Roadmap<D>& roadmap, const Cuts<D>& cuts,
                                           const ClassSearchOptions& options) {
  return search(roadmap, cuts, options);
}

template <int D>
std::vector<ClassPath<D>> shortest_classes(const Roadmap<D>& roadmap, const SampledSpace<D>& space,
                                           const ClassSearchOptions& options) {
  return search(roadmap, space, options);
}

template std::vector<ClassPath<2>> shortest_classes(const Roadmap<2>&, const Cuts<2>&,
                                                    const ClassSearchOptions&);
template std::vector<ClassPath<3>> shortest_classes(const Roadmap<3>&, const Cuts<3>&,
                                                    const ClassSearchOptions&);
template std::vector<ClassPath<2>> shortest_classes(const Roadmap<2>&, const SampledSpace<2>&,
                                                    const ClassSearchOptions&);
template std::vector<ClassPath<3>> shortest_classes(const Roadmap<3>&, const SampledSpace<3>&,
                                                    const ClassSearchOptions&);
template std::vector<ClassPath<4>> shortest_classes(const Roadmap<4>&, const SampledSpace<4>&,
                                                    const ClassSearchOptions&);

}  // namespace mocha
