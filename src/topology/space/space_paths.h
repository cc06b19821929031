#pragma once

#include <functional>
#include <vector>

#include "topology/paths/class_search.h"
#include "topology/roadmaps/visibility_prm.h"
#include "topology/signatures/h_signature.h"
#include "topology/space/space_region.h"
#include "world/distances/voxel_distance_field.h"

namespace mocha {

struct SpacePathOptions {
  ClearanceOptions clearance;
  int classes;           ///< at most this many paths
  double longest_ratio;  ///< a path that is longer than the shortest by this is none
  VisibilityPrmOptions roadmap;
};

/// A path of one class in space.
struct SpacePath {
  std::vector<Eigen::Vector3d> points;  ///< straight between them
  double length_m;
  Signature signature;
};

/// The shortest paths of pairwise different classes (paper IV-E) in space, shortest first: by a
/// sampled roadmap, and shortened as far as their class allows. None where there is no path, or
/// where start or goal keep no clearance. Once `should_stop()` says so, what was found by then is
/// returned as it is; that of the roadmap's options ends only the sampling.
std::vector<SpacePath> find_space_paths(const VoxelDistanceField& field, const SpaceRegion& region,
                                        const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
                                        const SpacePathOptions& options,
                                        const std::function<bool()>& should_stop);

}  // namespace mocha
