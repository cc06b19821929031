#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <vector>

#include "topology/roadmaps/roadmap.h"
#include "topology/roadmaps/sampled_space.h"
#include "topology/roadmaps/static_space.h"

namespace mocha {

struct VisibilityPrmOptions {
  int samples;         ///< points that are tried, at least 0
  std::uint64_t seed;  ///< the same one gives the same roadmap, on every machine
  double reach_m;      ///< farther points do not see each other, above 0
  /// Ends the sampling early; the roadmap is that of what was sampled by then.
  std::function<bool()> should_stop = [] { return false; };
};

/// A sampled roadmap that stays small however many samples are drawn, yet keeps a path of every
/// class that they showed (visibility PRM of Simeon, Laumond, Nissoux 2000; with classes by Zhou,
/// Pan, Gao, Shen 2021).
///
/// Where a sample is forbidden, the middle between it and a forbidden one nearby is tried instead.
/// Start and goal are the first guards. A sample that sees no guard becomes one (in time, one that
/// sees none before it or none after it). Another one connects each pair of guards that it sees, if
/// the way from guard to guard through it has a class that no connector of the two has yet, or is
/// shorter than that connector's way. Guards and connectors are the nodes; those that see each
/// other share an edge, straight and in order.
///
/// `first` are tried before what is drawn, in that order: places that are known to matter.
///
/// Start and goal see each other however far apart. Where one must not be at the start or at the
/// goal, that node has no edges. Throws std::invalid_argument for options out of range.
template <int D>
Roadmap<D> visibility_prm(const SampledSpace<D>& space, const Eigen::Matrix<double, D, 1>& start,
                          const Eigen::Matrix<double, D, 1>& goal,
                          const VisibilityPrmOptions& options,
                          const std::vector<Eigen::Matrix<double, D, 1>>& first = {});

/// Among obstacles that stand still.
template <int D>
Roadmap<D> visibility_prm(const ObstacleField<D>& field, const Cuts<D>& cuts,
                          const Eigen::AlignedBox<double, D>& bounds,
                          const Eigen::Matrix<double, D, 1>& start,
                          const Eigen::Matrix<double, D, 1>& goal,
                          const ClearanceOptions& clearance, const VisibilityPrmOptions& options) {
  return visibility_prm<D>(StaticSpace<D>(field, cuts, bounds, start, clearance), start, goal,
                           options);
}

extern template Roadmap<2> visibility_prm(const SampledSpace<2>&, const Eigen::Vector2d&,
                                          const Eigen::Vector2d&, const VisibilityPrmOptions&,
                                          const std::vector<Eigen::Vector2d>&);
extern template Roadmap<3> visibility_prm(const SampledSpace<3>&, const Eigen::Vector3d&,
                                          const Eigen::Vector3d&, const VisibilityPrmOptions&,
                                          const std::vector<Eigen::Vector3d>&);
extern template Roadmap<4> visibility_prm(const SampledSpace<4>&, const Eigen::Vector4d&,
                                          const Eigen::Vector4d&, const VisibilityPrmOptions&,
                                          const std::vector<Eigen::Vector4d>&);

}  // namespace mocha
