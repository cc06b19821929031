#include "planning/space/space_planner.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <utility>

#include "planning/candidates/parallel.h"

namespace mocha {
namespace {

constexpr std::uint64_t kSeed = 1;       // of the roadmaps
constexpr std::size_t kMostRegions = 4;  // that are kept, of a map in pieces
constexpr double kMoreTime = 1.25;       // for paths past what moves

bool is_certified(const SpaceCandidate& candidate) {
  return candidate.reason == PlanReason::kSolved;
}

bool has_curve(const SpaceCandidate& candidate) { return candidate.curve.pieces() > 0; }

/// Certified ones first, then those with a curve, then by cost; of each class the first. What has
/// no curve stays only where nothing has one.
void keep_best_of_each_class(std::vector<SpaceCandidate>& candidates) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const SpaceCandidate& a, const SpaceCandidate& b) {
                     if (is_certified(a) != is_certified(b)) return is_certified(a);
                     if (has_curve(a) != has_curve(b)) return has_curve(a);
                     return a.cost < b.cost;
                   });
  std::vector<SpaceCandidate> kept;
  for (SpaceCandidate& candidate : candidates) {
    const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const SpaceCandidate& other) {
      return other.signature == candidate.signature;
    });
    if (kept.empty() || (is_new && has_curve(candidate))) kept.push_back(std::move(candidate));
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
  if (!field_->bounds().contains(start)) return nullptr;
  const std::lock_guard<std::mutex> lock(regions_mutex_);
  for (const auto& region : regions_) {
    if (region->contains(start)) return region;
  }
  auto voxels = solid_voxels(*field_, options_.required_clearance_m(), start);
  if (!voxels) return nullptr;
  if (regions_.size() >= kMostRegions) regions_.erase(regions_.begin());
  regions_.push_back(
      std::make_shared<SpaceRegion>(*field_, options_.required_clearance_m(), std::move(*voxels)));
  return regions_.back();
}

/// Whether nothing can be planned, and why.
bool SpacePlanner::is_refused(const SpaceQuery& query, SpacePlan& plan) const {
  if (!query.start.allFinite() || !query.goal.allFinite() || query.start == query.goal) {
    plan.reason = PlanReason::kInvalidInput;
    plan.message = "start and goal have to be finite and different";
    return true;
  }
  const auto is_occupied = [&](const char* name, const Eigen::Vector3d& place, double required_m) {
    const double distance_m = field_->distance_bound(place);
    if (distance_m >= required_m && distance_m > 0.0) return false;
    char text[160];
    std::snprintf(
        text, sizeof text,
        "the %s %s has %.3f m to the nearest obstacle or to what is unknown, needs %.3f m", name,
        coordinates(place).c_str(), distance_m, required_m);
    plan.message = text;
    return true;
  };
  plan.reason = PlanReason::kStartOccupied;
  if (is_occupied("start", query.start, options_.required_clearance_m())) return true;
  plan.reason = PlanReason::kGoalOccupied;
  return is_occupied("goal", query.goal, options_.required_clearance_m());
}

SpacePathOptions SpacePlanner::path_options(const SpaceQuery& query) const {
  return {{options_.required_clearance_m(), 0.0},
          query.classes > 0 ? query.classes : options_.classes,
          options_.longest_ratio,
          {options_.prm_samples, kSeed, options_.prm_reach_m}};
}

/// Paths past what moves, that take as long as the static plan, and a little longer.
std::vector<TimedSpacePath> SpacePlanner::paths_among_moving(const SpaceQuery& query,
                                                             const SpaceRegion& region,
                                                             const std::vector<SpacePath>& paths,
                                                             const SpacePlan& without) const {
  double duration_s = 0.0;
  for (const SpaceCandidate& candidate : without.candidates) {
    if (candidate.curve.pieces() > 0) duration_s = std::max(duration_s, candidate.curve.duration());
  }
  if (duration_s == 0.0) return {};
  MovingQuery moving{
      {query.start, query.goal, 0.0, kMoreTime * duration_s}, options_.max_speed, {}};
  for (const Tube<3>& tube : query.moving)
    moving.tubes.push_back(enlarged<3>(tube, options_.required_clearance_m()));
  return find_moving_paths(*field_, region, moving, paths, path_options(query), query.should_stop);
}

void SpacePlanner::optimize_all(const std::vector<TimedSpacePath>& paths, const SpaceScene& scene,
                                const std::function<bool()>& should_stop, SpacePlan& plan) const {
  const std::size_t before = plan.candidates.size();
  plan.candidates.resize(before + paths.size());
  in_parallel(paths.size(), options_.threads, [&](std::size_t i) {
    plan.candidates[before + i] = optimizer_.optimize_path(paths[i], scene, should_stop);
  });
}

SpacePlan SpacePlanner::plan(const SpaceQuery& query) {
  SpacePlan plan;
  if (is_refused(query, plan)) return plan;
  const auto region = region_of(query.start);
  const std::vector<SpacePath> paths =
      region ? find_space_paths(*field_, *region, query.start, query.goal, path_options(query),
                                query.should_stop)
             : std::vector<SpacePath>();
  if (paths.empty()) {
    const bool is_late = query.should_stop();
    plan.reason = is_late ? PlanReason::kBudgetExhausted : PlanReason::kNoPath;
    plan.message = (is_late ? "out of time before there was a path from " : "no path from ") +
                   coordinates(query.start) + " to " + coordinates(query.goal);
    return plan;
  }
  const SpaceScene scene{*field_, region->cuts(), query.moving};
  std::vector<TimedSpacePath> untimed;
  for (const SpacePath& path : paths) untimed.push_back({path.points, {}});
  optimize_all(untimed, scene, query.should_stop, plan);
  if (!query.moving.empty()) {
    optimize_all(paths_among_moving(query, *region, paths, plan), scene, query.should_stop, plan);
  }
  keep_best_of_each_class(plan.candidates);
  const SpaceCandidate& best = plan.candidates.front();
  const bool is_late = !is_certified(best) && query.should_stop();
  plan.reason = is_late ? PlanReason::kBudgetExhausted : best.reason;
  plan.message = (is_late ? "out of time: " : "") + outcome(best);
  return plan;
}

}  // namespace mocha
