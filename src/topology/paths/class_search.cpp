#include "topology/paths/class_search.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <stdexcept>
#include <string>
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
};

/// Arcs by the node that they lead from.
class Arcs {
 public:
  /// `visit` calls what it is given with (from, arc) for each arc; it is called twice.
  template <typename Visit>
  Arcs(std::size_t nodes, const Visit& visit) : first_(nodes + 1, 0) {
    visit([&](int from, const Arc&) { ++first_[from + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    arcs_.resize(first_.back());
    std::vector<int> next(first_.begin(), first_.end() - 1);
    visit([&](int from, const Arc& arc) { arcs_[next[from]++] = arc; });
  }

  std::size_t nodes() const { return first_.size() - 1; }
  std::size_t size() const { return arcs_.size(); }
  /// Those of a node are numbers first(node) to before first(node + 1).
  int first(int node) const { return first_[node]; }
  const Arc& operator[](int number) const { return arcs_[number]; }

 private:
  std::vector<int> first_;
  std::vector<Arc> arcs_;
};

/// Each edge in both directions.
template <int D>
Arcs arcs_of(const Roadmap<D>& roadmap, const Cuts<D>&) {
  return Arcs(roadmap.nodes.size(), [&](const auto& add) {
    for (std::size_t i = 0; i < roadmap.edges.size(); ++i) {
      const auto& edge = roadmap.edges[i];
      add(edge.from, {edge.to, static_cast<int>(i), edge.length_m});
      add(edge.to, {edge.from, static_cast<int>(i), edge.length_m});
    }
  });
}

/// Each edge in the directions that are in order; turned round where `back` is set.
template <int D>
Arcs arcs_of(const Roadmap<D>& roadmap, const SampledSpace<D>& space, bool back = false) {
  return Arcs(roadmap.nodes.size(), [&](const auto& add) {
    const auto add_if_in_order = [&](int from, int to, std::size_t i) {
      if (!space.in_order(roadmap.nodes[from].position, roadmap.nodes[to].position)) return;
      if (back) std::swap(from, to);
      add(from, {to, static_cast<int>(i), roadmap.edges[i].length_m});
    };
    for (std::size_t i = 0; i < roadmap.edges.size(); ++i) {
      add_if_in_order(roadmap.edges[i].from, roadmap.edges[i].to, i);
      add_if_in_order(roadmap.edges[i].to, roadmap.edges[i].from, i);
    }
  });
}

template <int D>
SignatureKey key_along(int from, const Arc& arc, const Roadmap<D>& roadmap, const Cuts<D>& cuts) {
  const auto& edge = roadmap.edges[arc.edge];
  SignatureKey key = 0;
  typename Roadmap<D>::Point last = roadmap.nodes[edge.from].position;
  for (const auto& point : edge.between) {
    key += key_of<D>(cuts, last, point);
    last = point;
  }
  key += key_of<D>(cuts, last, roadmap.nodes[edge.to].position);
  return edge.from == from ? key : SignatureKey(0) - key;
}

template <int D>
SignatureKey key_along(int from, const Arc& arc, const Roadmap<D>& roadmap,
                       const SampledSpace<D>& space) {
  return space.key(roadmap.nodes[from].position, roadmap.nodes[arc.to].position);
}

/// Shortest distance to the goal of every node from which it is no longer than the options allow;
/// of others, none shorter. `back`: the arcs that lead to each node, turned round.
std::vector<double> distances_to_goal(const Arcs& back, const ClassSearchOptions& options) {
  std::vector<double> distance_m(back.nodes(), kInfinity);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
  distance_m[Roadmap<2>::kGoal] = 0.0;
  queue.push({0.0, Roadmap<2>::kGoal});
  double longest_m = options.longest_m;
  while (!queue.empty()) {
    const auto [reached_m, node] = queue.top();
    queue.pop();
    if (reached_m > longest_m) break;
    if (reached_m > distance_m[node]) continue;
    if (node == Roadmap<2>::kStart)
      longest_m = std::min(longest_m, (1.0 + kRounding) * options.longest_ratio * reached_m);
    for (int i = back.first(node); i < back.first(node + 1); ++i) {
      const double next_m = reached_m + back[i].length_m;
      if (next_m >= distance_m[back[i].to]) continue;
      distance_m[back[i].to] = next_m;
      queue.push({next_m, back[i].to});
    }
  }
  return distance_m;
}

/// Where each edge has an arc in both directions, the arcs are their own inverses.
template <int D>
std::vector<double> distances_to_goal(const Arcs& arcs, const Roadmap<D>&, const Cuts<D>&,
                                      const ClassSearchOptions& options) {
  return distances_to_goal(arcs, options);
}

template <int D>
std::vector<double> distances_to_goal(const Arcs&, const Roadmap<D>& roadmap,
                                      const SampledSpace<D>& space,
                                      const ClassSearchOptions& options) {
  return distances_to_goal(arcs_of(roadmap, space, true), options);
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

  using KeyOf = std::function<SignatureKey(int from, const Arc&)>;

  Search(const Arcs& arcs, KeyOf key_of, std::vector<double> to_goal_m,
         const ClassSearchOptions& options)
      : arcs_(arcs),
        key_of_(std::move(key_of)),
        keys_(arcs.size()),
        has_key_(arcs.size(), false),
        to_goal_m_(std::move(to_goal_m)),
        options_(options),
        longest_m_(std::min(options.longest_m, (1.0 + kRounding) * options.longest_ratio *
                                                   to_goal_m_[Roadmap<2>::kStart])),
        most_signatures_(static_cast<std::size_t>(kSignatures) * options.classes),
        seen_(arcs.nodes()),
        visited_by_(arcs.nodes(), kNone) {}

  /// The last steps of the paths found.
  std::vector<int> run() {
    std::vector<int> found;
    if (!(to_goal_m_[Roadmap<2>::kStart] <= longest_m_) ||
        to_goal_m_[Roadmap<2>::kStart] == kInfinity)
      return found;
    push({Roadmap<2>::kStart, kNone, kNone, 0, 0.0});
    while (!queue_.empty() && static_cast<int>(found.size()) < options_.classes &&
           !options_.should_stop()) {
      const int current = queue_.top().second;
      queue_.pop();
      const Step step = steps_[current];
      if (seen_[step.node].size() >= most_signatures_ || is_seen(step)) continue;
      seen_[step.node].push_back(step.key);
      if (step.node == Roadmap<2>::kGoal) {
        found.push_back(current);
        continue;
      }
      for (int i = arcs_.first(step.node); i < arcs_.first(step.node + 1); ++i) {
        const Arc& arc = arcs_[i];
        const double length_m = step.length_m + arc.length_m;
        if (length_m + to_goal_m_[arc.to] > longest_m_) continue;
        const Step next{arc.to, current, arc.edge, step.key + key(step.node, i), length_m};
        if (!is_seen(next) && !is_on_path(next.node, current)) push(next);
      }
    }
    return found;
  }

  const Step& step(int index) const { return steps_[index]; }

 private:
  void push(const Step& step) {
    const double bound_m = step.length_m + to_goal_m_[step.node];
    queue_.push({bound_m, static_cast<int>(steps_.size())});
    steps_.push_back(step);
  }

  bool is_seen(const Step& step) const {
    const std::vector<SignatureKey>& seen = seen_[step.node];
    return std::find(seen.begin(), seen.end(), step.key) != seen.end();
  }

  /// Of an arc; most are never asked for.
  SignatureKey key(int from, int arc) {
    if (!has_key_[arc]) keys_[arc] = key_of_(from, arcs_[arc]);
    has_key_[arc] = true;
    return keys_[arc];
  }

  /// Whether a node is one of those of the path to the step `last`, all of which have been seen.
  bool is_on_path(int node, int last) {
    if (seen_[node].empty()) return false;
    if (visited_by_[steps_[last].node] != last) {
      for (int i = last; i != kNone; i = steps_[i].before) visited_by_[steps_[i].node] = last;
    }
    return visited_by_[node] == last;
  }

  const Arcs& arcs_;
  const KeyOf key_of_;
  std::vector<SignatureKey> keys_;  // of the arcs that have one
  std::vector<bool> has_key_;
  const std::vector<double> to_goal_m_;
  const ClassSearchOptions options_;
  const double longest_m_;
  const std::size_t most_signatures_;
  std::vector<Step> steps_;
  std::vector<std::vector<SignatureKey>> seen_;  // of each node
  std::vector<int> visited_by_;  // each node: the last step of the last path that was marked there
  using Entry = std::pair<double, int>;  // bound and step; ties in order of age
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
  Search search(
      arcs, [&](int from, const Arc& arc) { return key_along<D>(from, arc, roadmap, classes); },
      distances_to_goal(arcs, roadmap, classes, options), options);
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
