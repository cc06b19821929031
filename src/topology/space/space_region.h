#pragma once

#include "topology/roadmaps/roadmap.h"
#include "topology/space/obstacle_curves.h"
#include "topology/space/solid_voxels.h"

namespace mocha {

/// All that searches for paths ask of what can be reached in a map: made once, which takes about as
/// long as the distances of the map do, and asked often.
class SpaceRegion {
 public:
  /// `voxels` are those of solid_voxels() for this field and clearance.
  SpaceRegion(const VoxelDistanceField& field, double clearance_m, SolidVoxels voxels);

  /// Whether a place belongs to it, or is close enough to be one of its margins.
  bool contains(const Eigen::Vector3d& p) const;

  const ObstacleCurves& curves() const { return curves_; }
  const Cuts<3>& cuts() const { return cuts_; }
  /// The landmarks of the region as a roadmap, without start and goal: the first two nodes are
  /// none.
  const Roadmap<3>& landmarks() const { return landmarks_; }

 private:
  SolidVoxels voxels_;
  ObstacleCurves curves_;
  Cuts<3> cuts_;
  Roadmap<3> landmarks_;
};

}  // namespace mocha
