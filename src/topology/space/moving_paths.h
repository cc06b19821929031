#pragma once

#include <functional>
#include <vector>

#include "topology/roadmaps/visibility_prm.h"
#include "topology/space/space_paths.h"
#include "topology/space_time/space_time.h"

namespace mocha {

/// From where to where, among what moves.
struct MovingQuery {
  SpaceTimeEnds<3> ends;
  double max_speed;            ///< [m/s]
  std::vector<Tube<3>> tubes;  ///< as one has to keep away from them, in the time of the ends
};

/// A path in space and time.
struct TimedSpacePath {
  std::vector<Eigen::Vector3d> points;  ///< straight and uniform between them
  std::vector<double> times_s;          ///< of the points, from 0 at the start
};

/// Paths past what moves (paper V-C), shortest in space-time first: a roadmap is sampled there,
/// beside motions along the static paths at several speeds, and searched for the shortest paths
/// that differ in some projection onto (x, y, t), (x, z, t) or (y, z, t). In space and time the
/// free space around balls has but one class, so what differs are not classes but beginnings of an
/// optimisation that ends in other local optima. Both `should_stop` are as in find_space_paths().
std::vector<TimedSpacePath> find_moving_paths(const VoxelDistanceField& field,
                                              const SpaceRegion& region, const MovingQuery& query,
                                              const std::vector<SpacePath>& static_paths,
                                              const SpacePathOptions& options,
                                              const std::function<bool()>& should_stop);

}  // namespace mocha
