#pragma once

#include <Eigen/Core>
#include <vector>

#include "topology/roadmaps/shared_corners.h"

namespace mocha {

/// The graph that searches for paths run on. Its start and its goal are nodes like all others.
template <int D>
struct Roadmap {
  using Point = Eigen::Matrix<double, D, 1>;

  struct Node {
    Point position;
    double clearance_m;  ///< to the nearest obstacle
  };

  struct Edge {
    int from;                      ///< index of a node
    int to;                        ///< index of a node
    SharedCorners<Point> between;  ///< of the polyline from one to the other, ends left out
    double length_m;               ///< of the polyline
    double clearance_m;            ///< smallest one along it
  };

  static constexpr int kStart = 0;
  static constexpr int kGoal = 1;

  std::vector<Node> nodes;  ///< the first two are start and goal
  /// Two nodes may share several. Undirected, except in a space with an order, such as time.
  std::vector<Edge> edges;
};

}  // namespace mocha
