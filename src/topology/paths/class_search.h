#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "topology/roadmaps/roadmap.h"
#include "topology/roadmaps/sampled_space.h"
#include "topology/signatures/h_signature.h"

namespace mocha {

struct ClassSearchOptions {
  int classes;           ///< at most this many, at least 1
  double longest_ratio;  ///< longer than the shortest by more than this is not a path; >= 1
  double longest_m = std::numeric_limits<double>::infinity();  ///< longer is none, either
  /// Ends the search early, with the paths that it has found.
  std::function<bool()> should_stop = [] { return false; };
};

/// A path through a roadmap from start to goal.
template <int D>
struct ClassPath {
  std::vector<Eigen::Matrix<double, D, 1>> points;  ///< straight between them
  double length_m;
};

/// The shortest paths of pairwise different signatures, shortest first; none visits a node twice.
///
/// A* over pairs (node, signature so far) with the exact distance to the goal as its bound
/// (Bhattacharya, Likhachev, Kumar 2012 use the same augmented graph). A class is missed, or found
/// with a longer path, only where it has a shorter walk that visits some node twice.
///
/// Each signature of a node continues to a result of its own, unless the way on is barred by where
/// it has been. So of one node only a few times as many signatures are looked at as there are
/// results, and the work grows with nodes times results, however many classes there are.
template <int D>
std::vector<ClassPath<D>> shortest_classes(const Roadmap<D>& roadmap, const Cuts<D>& cuts,
                                           const ClassSearchOptions& options);

/// Likewise through a roadmap of straight edges, by the classes of the space in which it was
/// sampled. Edges lead whichever way is in order.
template <int D>
std::vector<ClassPath<D>> shortest_classes(const Roadmap<D>& roadmap, const SampledSpace<D>& space,
                                           const ClassSearchOptions& options);

extern template std::vector<ClassPath<2>> shortest_classes(const Roadmap<2>&, const Cuts<2>&,
                                                           const ClassSearchOptions&);
extern template std::vector<ClassPath<3>> shortest_classes(const Roadmap<3>&, const Cuts<3>&,
                                                           const ClassSearchOptions&);
extern template std::vector<ClassPath<2>> shortest_classes(const Roadmap<2>&,
                                                           const SampledSpace<2>&,
                                                           const ClassSearchOptions&);
extern template std::vector<ClassPath<3>> shortest_classes(const Roadmap<3>&,
                                                           const SampledSpace<3>&,
                                                           const ClassSearchOptions&);
extern template std::vector<ClassPath<4>> shortest_classes(const Roadmap<4>&,
                                                           const SampledSpace<4>&,
                                                           const ClassSearchOptions&);

}  // namespace mocha
