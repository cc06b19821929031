#pragma once

#include <functional>
#include <vector>

#include "topology/roadmaps/visibility_prm.h"
#include "topology/space/space_paths.h"
#include "topology/space_time/projected_signature.h"

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

struct TimedSpacePaths {
  std::vector<TimedSpacePath> paths;  ///< that pairwise differ, shortest in space-time first
  int found = 0;                      ///< before those were left out that do not (paper, Prop. 1)
};

/// Paths past what moves (paper V-C): a roadmap is sampled in space-time, beside motions along the
/// static paths at several speeds; of the shortest paths through it those are kept that differ in
/// some projection.
TimedSpacePaths find_moving_paths(const VoxelDistanceField& field, const SpaceRegion& region,
                                  const MovingQuery& query,
                                  const std::vector<SpacePath>& static_paths,
                                  const SpacePathOptions& options,
                                  const std::function<bool()>& should_stop);

}  // namespace mocha
