#pragma once

#include <functional>
#include <map>
#include <queue>
#include <utility>
#include <vector>

#include "topology/roadmaps/roadmap.h"
#include "topology/roadmaps/sampled_space.h"

namespace mocha {

/// The length of the shortest path from start to goal in each class, of those no longer than
/// `longest_m`.
template <int D>
std::map<SignatureKey, double> shortest_of_each_class(const Roadmap<D>& roadmap,
                                                      const SampledSpace<D>& space,
                                                      double longest_m, bool directed = false) {
  struct Arc {
    int to;
    double length_m;
    SignatureKey key;
  };
  std::vector<std::vector<Arc>> arcs(roadmap.nodes.size());
  for (const auto& edge : roadmap.edges) {
    const SignatureKey key =
        space.key(roadmap.nodes[edge.from].position, roadmap.nodes[edge.to].position);
    arcs[edge.from].push_back({edge.to, edge.length_m, key});
    if (!directed) arcs[edge.to].push_back({edge.from, edge.length_m, SignatureKey(0) - key});
  }
  using State = std::pair<int, SignatureKey>;
  using Entry = std::pair<double, State>;
  std::map<State, double> best_m;
  std::map<SignatureKey, double> classes;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
  queue.push({0.0, {Roadmap<D>::kStart, 0}});
  while (!queue.empty()) {
    const auto [reached_m, state] = queue.top();
    queue.pop();
    if (reached_m > longest_m || !best_m.try_emplace(state, reached_m).second) continue;
    if (state.first == Roadmap<D>::kGoal) classes.try_emplace(state.second, reached_m);
    for (const Arc& arc : arcs[state.first]) {
      queue.push({reached_m + arc.length_m, {arc.to, state.second + arc.key}});
    }
  }
  return classes;
}

}  // namespace mocha
