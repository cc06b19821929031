#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "planning/space/space_optimizer.h"
#include "planning/space/space_plan.h"
#include "planning/space/space_planner_options.h"
#include "topology/space/moving_paths.h"
#include "topology/space/space_region.h"
#include "world/distances/voxel_distance_field.h"

namespace mocha {

/// From where to where [m, map frame].
struct SpaceQuery {
  Eigen::Vector3d start;
  Eigen::Vector3d goal;
  int classes = 0;  ///< paths of different topology at most; 0: as the options say
  /// Balls that move, in time since the motion begins: as large as they are. What they do after the
  /// robot has arrived is not looked at.
  std::vector<Tube<3>> moving = {};
  /// Ends the planning before its time is over; several threads may call it at once.
  std::function<bool()> should_stop = [] { return false; };
};

/// Plans in space, paper III to V with d = 3: several paths of different classes, each optimised
/// with camouflage and certified; the cheapest is selected. Among what moves there are paths in
/// space-time besides.
class SpacePlanner {
 public:
  /// `now_s` is a steady clock [s], which several threads may read at once.
  SpacePlanner(std::shared_ptr<const VoxelDistanceField> field, const SpacePlannerOptions& options,
               std::function<double()> now_s);

  /// What can be reached from a place, as topology sees it; null where that is nowhere. Made when
  /// it is first asked for, which takes about as long as the field did.
  std::shared_ptr<const SpaceRegion> region_of(const Eigen::Vector3d& start);

  /// Several threads may plan at once.
  SpacePlan plan(const SpaceQuery& query);

  const VoxelDistanceField& field() const { return *field_; }

 private:
  using Candidates = std::vector<SpaceCandidate>;
  /// What says whether that share of the planning time is over.
  using Past = std::function<std::function<bool()>(double share)>;

  bool is_refused(const SpaceQuery& query, SpacePlan& plan) const;
  SpacePathOptions path_options(const SpaceQuery& query, std::function<bool()> stop_sampling) const;
  std::vector<TimedSpacePath> paths_among_moving(const SpaceQuery& query, const SpaceRegion& region,
                                                 const std::vector<SpacePath>& paths,
                                                 const Candidates& without, const Past& past) const;
  void optimize_all(const std::vector<TimedSpacePath>& paths, const SpaceScene& scene,
                    const std::function<bool()>& should_stop, Candidates& candidates) const;
  Candidates find_candidates(const SpaceQuery& query, const SpaceRegion& region,
                             const Past& past) const;

  const std::shared_ptr<const VoxelDistanceField> field_;
  const SpacePlannerOptions options_;
  const SpaceOptimizer optimizer_;
  const std::function<double()> now_s_;
  std::mutex regions_mutex_;
  std::vector<std::shared_ptr<const SpaceRegion>> regions_;
};

}  // namespace mocha
