#include "topology/space/space_region.h"

#include <utility>

#include "topology/roadmaps/static_space.h"
#include "topology/space/landmarks.h"

namespace mocha {
namespace {

Roadmap<3> roadmap_of(const Landmarks& landmarks, const StaticSpace<3>& space) {
  constexpr int kEnds = Roadmap<3>::kGoal + 1;
  Roadmap<3> roadmap;
  roadmap.nodes.resize(kEnds);
  for (const Eigen::Vector3d& place : landmarks.places)
    roadmap.nodes.push_back({place, space.clearance_m(place).value_or(0.0)});
  for (const auto& [a, b] : landmarks.neighbours) {
    const Eigen::Vector3d& p = landmarks.places[a];
    const Eigen::Vector3d& q = landmarks.places[b];
    const auto clearance_m = space.clearance_m(p, q);
    if (clearance_m)
      roadmap.edges.push_back({a + kEnds, b + kEnds, {}, (q - p).norm(), *clearance_m});
  }
  return roadmap;
}

}  // namespace

SpaceRegion::SpaceRegion(const VoxelDistanceField& field, double clearance_m, SolidVoxels voxels)
    : voxels_(std::move(voxels)), curves_(obstacle_curves(voxels_)), cuts_(curves_.curves) {
  const Landmarks found = mocha::landmarks(voxels_, field, clearance_m);
  std::vector<float>().swap(voxels_.distance_m);  // nobody asks for it any more
  if (found.places.empty()) return;
  landmarks_ = roadmap_of(found, StaticSpace<3>(field, cuts_, field.bounds(), found.places.front(),
                                                {clearance_m, 0.0}));
}

bool SpaceRegion::contains(const Eigen::Vector3d& p) const {
  const Eigen::Vector3i voxel = voxels_.voxel_at(p);
  return voxels_.contains(voxel) && voxels_.solid[voxels_.number(voxel)] == 0;
}

}  // namespace mocha
