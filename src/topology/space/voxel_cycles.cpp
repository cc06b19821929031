#include "topology/space/voxel_cycles.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "topology/space/voxel_thinning.h"

namespace mocha {
namespace {

constexpr int kOutside = 0;  // the node that stands for all that is outside of the map
constexpr int kNoNode = -1;
constexpr int kLeastShell = 6;  // voxels about one that is hollow

/// The sides of the map that a voxel touches, a bit for each.
unsigned rim_of(const Eigen::Vector3i& voxel, const Eigen::Vector3i& size) {
  unsigned rim = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (voxel[axis] == 0) rim |= 1u << axis;
    if (voxel[axis] == size[axis] - 1) rim |= 8u << axis;
  }
  return rim;
}

/// Solid voxels as nodes; neighbours are linked.
struct VoxelGraph {
  std::vector<int> number;    // of the voxel of each node
  std::vector<unsigned> rim;  // sides of the map that it touches; the outside has them all
  std::vector<std::vector<int>> links;

  /// Whether three nodes that are linked to each other touch in one place, so that they enclose
  /// nothing. Voxels do; with the outside, they do where two of them are at the same side.
  bool touch(int a, int b, int c) const {
    return (a != kOutside && b != kOutside && c != kOutside) || (rim[a] & rim[b] & rim[c]) != 0;
  }
};

VoxelGraph graph_of(const SolidVoxels& voxels) {
  VoxelGraph graph;
  std::unordered_map<int, int> node_of;
  graph.number.push_back(kNoNode);
  graph.rim.push_back(~0u);
  for (int number = 0; number < static_cast<int>(voxels.solid.size()); ++number) {
    if (voxels.solid[number] == 0 || !voxels.contains(voxels.voxel(number))) continue;
    node_of[number] = static_cast<int>(graph.number.size());
    graph.number.push_back(number);
    graph.rim.push_back(rim_of(voxels.voxel(number), voxels.size));
  }
  graph.links.resize(graph.number.size());
  const Eigen::Vector3i steps = voxels.steps();
  for (int node = 1; node < static_cast<int>(graph.number.size()); ++node) {
    for (int i = 0; i < 27; ++i) {
      const Eigen::Vector3i away(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      const int next = graph.number[node] + away.dot(steps);
      if (next == graph.number[node]) continue;
      const auto other = node_of.find(next);
      if (other != node_of.end()) graph.links[node].push_back(other->second);
    }
    if (graph.rim[node] == 0) continue;
    graph.links[node].push_back(kOutside);
    graph.links[kOutside].push_back(node);
  }
  for (auto& links : graph.links) std::sort(links.begin(), links.end());
  return graph;
}

/// Breadth first from the outside, then from what hangs together elsewhere.
class SpanningForest {
 public:
  explicit SpanningForest(const VoxelGraph& graph)
      : parent_(graph.links.size(), kNoNode), depth_(graph.links.size(), kNoNode) {
    for (int root = 0; root < static_cast<int>(graph.links.size()); ++root) {
      if (depth_[root] != kNoNode) continue;
      depth_[root] = 0;
      std::vector<int> queue = {root};
      for (std::size_t i = 0; i < queue.size(); ++i) {
        for (const int next : graph.links[queue[i]]) {
          if (depth_[next] != kNoNode) continue;
          depth_[next] = depth_[queue[i]] + 1;
          parent_[next] = queue[i];
          queue.push_back(next);
        }
      }
    }
  }

  bool has(int a, int b) const { return parent_[a] == b || parent_[b] == a; }

  /// From a up to where the branches of a and b meet, and down to b.
  std::vector<int> path(int a, int b) const {
    std::vector<int> up = {a};
    std::vector<int> down = {b};
    while (up.back() != down.back()) {
      std::vector<int>& deeper = depth_[up.back()] >= depth_[down.back()] ? up : down;
      deeper.push_back(parent_[deeper.back()]);
    }
    up.insert(up.end(), down.rbegin() + 1, down.rend());
    return up;
  }

 private:
  std::vector<int> parent_;
  std::vector<int> depth_;
};

/// Edges outside of the forest, each of which closes a cycle, less those whose cycle is a sum of
/// others' and of triangles that enclose nothing.
class CycleEdges {
 public:
  CycleEdges(const VoxelGraph& graph, const SpanningForest& forest) {
    for (int a = 0; a < static_cast<int>(graph.links.size()); ++a) {
      for (const int b : graph.links[a]) {
        if (b > a && !forest.has(a, b)) {
          id_[{a, b}] = static_cast<int>(edges_.size());
          edges_.emplace_back(a, b);
        }
      }
    }
    for (const auto& [a, b] : edges_) {
      std::vector<int> shared;
      std::set_intersection(graph.links[a].begin(), graph.links[a].end(), graph.links[b].begin(),
                            graph.links[b].end(), std::back_inserter(shared));
      for (const int c : shared) {
        if (graph.touch(a, b, c)) reduce(triangle(a, b, c));
      }
    }
  }

  std::vector<std::pair<int, int>> essential() const {
    std::vector<std::pair<int, int>> left;
    for (int i = 0; i < static_cast<int>(edges_.size()); ++i) {
      if (row_of_.count(i) == 0) left.push_back(edges_[i]);
    }
    return left;
  }

 private:
  using Row = std::set<int>;  // edges, summed modulo 2

  Row triangle(int a, int b, int c) const {
    Row row;
    for (auto [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(a, c)}) {
      const auto known = id_.find(std::minmax(from, to));
      if (known != id_.end()) row.insert(known->second);
    }
    return row;
  }

  void reduce(Row row) {
    while (!row.empty()) {
      const auto pivot = row_of_.find(*row.rbegin());
      if (pivot == row_of_.end()) {
        const int last = *row.rbegin();
        row_of_[last] = std::move(row);
        return;
      }
      for (const int edge : pivot->second) {
        if (!row.erase(edge)) row.insert(edge);
      }
    }
  }

  std::vector<std::pair<int, int>> edges_;
  std::map<std::pair<int, int>, int> id_;
  std::unordered_map<int, Row> row_of_;  // by its last edge, which it makes a sum of others
};

/// Of a closed path through the graph, whose last node is linked to its first. Through the outside,
/// it is turned so that it begins and ends there.
VoxelChain chain_of(std::vector<int> nodes, const VoxelGraph& graph) {
  const auto outside = std::find(nodes.begin(), nodes.end(), kOutside);
  const bool is_closed = outside == nodes.end();
  if (!is_closed) {
    std::rotate(nodes.begin(), outside, nodes.end());
    nodes.erase(nodes.begin());
  }
  VoxelChain chain{{}, is_closed};
  for (const int node : nodes) chain.voxels.push_back(graph.number[node]);
  return chain;
}

}  // namespace

VoxelCycles voxel_cycles(const SolidVoxels& thinned) {
  const VoxelGraph graph = graph_of(thinned);
  const SpanningForest forest(graph);
  VoxelCycles cycles;
  for (const auto& [a, b] : CycleEdges(graph, forest).essential())
    cycles.chains.push_back(chain_of(forest.path(a, b), graph));
  for (std::size_t node = 1; node < graph.number.size(); ++node) {
    const VoxelKind kind = kind_of(thinned, graph.number[node]);
    if (kind.solid_parts == 0) ++cycles.bodies;
    if (kind.solid_parts > 0 && kind.open_parts > 1) ++cycles.surface_voxels;
  }
  // Fewer enclose nothing: they are where curves meet.
  if (cycles.surface_voxels < kLeastShell) cycles.surface_voxels = 0;
  return cycles;
}

}  // namespace mocha
