#pragma once

#include <vector>

#include "topology/h_signature.h"
#include "topology/roadmap.h"

namespace mocha {

struct ClassSearchRules {
  int classes = 6;             ///< at most this many, at least 1
  double longest_ratio = 2.0;  ///< longer than the shortest by more than this is not a way; >= 1
};

/// A way through a roadmap from start to goal.
template <int D>
struct ClassPath {
  std::vector<Eigen::Matrix<double, D, 1>> points;  ///< straight between them
  double length_m;
};

/// The shortest paths of pairwise different signatures, shortest first; none visits a node twice.
///
/// A* over pairs (node, signature so far) with the exact distance to the goal as its bound. Of one
/// node no more signatures are looked at than there are results, as each of them continues to a
/// result of its own, so the work grows with nodes times results, however many classes there are
/// (Bhattacharya, Likhachev, Kumar 2012 use the same augmented graph).
template <int D>
std::vector<ClassPath<D>> shortest_classes(const Roadmap<D>& roadmap, const Cuts<D>& cuts,
                                           const ClassSearchRules& rules);

extern template std::vector<ClassPath<2>> shortest_classes(const Roadmap<2>&, const Cuts<2>&,
                                                           const ClassSearchRules&);
extern template std::vector<ClassPath<3>> shortest_classes(const Roadmap<3>&, const Cuts<3>&,
                                                           const ClassSearchRules&);

}  // namespace mocha
