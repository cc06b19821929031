#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "topology/roadmaps/roadmap.h"
#include "topology/roadmaps/skeleton.h"
#include "topology/static_map/obstacle_group.h"

namespace mocha {

/// The roadmap on the skeleton of the free space between all cover circles (paper IV-E): on the
/// edges of their Apollonius diagram, the Voronoi diagram of circles.
///
/// All obstacles can be gone round, also those on the rim of `bounds`: a virtual wall, which counts
/// as an obstacle, runs round the bounds, the circles, start and goal, four required clearances
/// away.
///
/// Equal input gives an equal roadmap. Throws std::invalid_argument for values that are not numbers
/// or beyond 1e6 m, negative radii, empty bounds and a required clearance that is not above 0.
Roadmap<2> apollonius_roadmap(const std::vector<ObstacleGroup>& groups,
                              const Eigen::AlignedBox2d& bounds, const Vector2& start,
                              const Vector2& goal, const SkeletonOptions& options);

}  // namespace mocha
