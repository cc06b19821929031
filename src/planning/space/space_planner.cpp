#include "planning/space/space_planner.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "planning/candidates/parallel.h"
#include "topology/space/space_paths.h"

namespace mocha {
namespace {

constexpr std::uint64_t kSeed = 1;  // of the roadmap

bool is_certified(const SpaceCandidate& candidate) {
  return candidate.reason == PlanReason::kSolved;
}

/// Certified ones first, then by cost; of each class the first.
void keep_best_of_each_class(std::vector<SpaceCandidate>& candidates) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const SpaceCandidate& a, const SpaceCandidate& b) {
                     if (is_certified(a) != is_certified(b)) return is_certified(a);
                     return a.cost < b.cost;
                   });
  std::vector<SpaceCandidate> kept;
  for (SpaceCandidate& candidate : candidates) {
    const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const SpaceCandidate& other) {
      return other.signature == candidate.signature;
    });
    if (is_new) kept.push_back(std::move(candidate));
  }
  candidates = std::move(kept);
}

std::string coordinates(const Eigen::Vector3d& p) {
  char text[96];
  std::snprintf(text, sizeof text, "(%.2f, %.2f, %.2f)", p.x(), p.y(), p.z());
  return text;
}

}  // namespace

SpacePlanner::SpacePlanner(std::shared_ptr<const VoxelDistanceField> field,
                           const SpacePlannerOptions& options)
    : field_(std::move(field)), options_(options), optimizer_(options) {}

std::shared_ptr<const SpaceRegion> SpacePlanner::region_of(const Eigen::Vector3d& start) {
  for (const auto& region : regions_) {
    if (region->contains(start)) return region;
  }
  auto voxels =
      solid_voxels(*field_, options_.required_clearance_m(), start, options_.escape_radius_m);
  if (!voxels) return nullptr;
  regions_.push_back(
      std::make_shared<SpaceRegion>(*field_, options_.required_clearance_m(), std::move(*voxels)));
  return regions_.back();
}

PlanReason SpacePlanner::fault_of(const SpaceQuery& query) const {
  if (!query.start.allFinite() || !query.goal.allFinite() || query.start == query.goal)
    return PlanReason::kInvalidInput;
  if (field_->distance_bound(query.start) <= options_.radius_m) return PlanReason::kStartOccupied;
  if (field_->distance_bound(query.goal) < options_.required_clearance_m())
    return PlanReason::kGoalOccupied;
  return PlanReason::kSolved;
}

SpacePlan SpacePlanner::plan(const SpaceQuery& query) {
  SpacePlan plan;
  plan.reason = fault_of(query);
  if (plan.reason == PlanReason::kInvalidInput)
    plan.message = "start and goal have to be finite and different";
  if (plan.reason == PlanReason::kStartOccupied || plan.reason == PlanReason::kGoalOccupied) {
    const Eigen::Vector3d& place =
        plan.reason == PlanReason::kStartOccupied ? query.start : query.goal;
    char text[128];
    std::snprintf(text, sizeof text,
                  " has %.3f m to the nearest obstacle; the robot's radius is %.3f m",
                  field_->distance_bound(place), options_.radius_m);
    plan.message = coordinates(place) + text;
  }
  if (plan.reason != PlanReason::kSolved) return plan;
  const auto region = region_of(query.start);
  std::vector<SpacePath> paths;
  if (region) {
    paths = find_space_paths(*field_, *region, query.start, query.goal,
                             {{options_.required_clearance_m(), options_.escape_radius_m},
                              options_.classes,
                              options_.longest_ratio,
                              {options_.prm_samples, kSeed, options_.prm_reach_m}},
                             query.should_stop);
  }
  if (paths.empty()) {
    plan.reason = query.should_stop() ? PlanReason::kBudgetExhausted : PlanReason::kNoPath;
    plan.message = "no path from " + coordinates(query.start) + " to " + coordinates(query.goal);
    return plan;
  }
  plan.candidates.resize(paths.size());
  in_parallel(paths.size(), options_.threads, [&](std::size_t i) {
    plan.candidates[i] =
        optimizer_.optimize_path(paths[i].points, *field_, region->cuts(), query.should_stop);
  });
  keep_best_of_each_class(plan.candidates);
  const SpaceCandidate& best = plan.candidates.front();
  plan.reason = best.reason;
  plan.message = is_certified(best) ? "solved" : describe(best.violation);
  return plan;
}

}  // namespace mocha
