#include "planning/space/space_planner.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <utility>

#include "planning/candidates/parallel.h"

namespace mocha {
namespace {

constexpr std::uint64_t kSeed = 1;       // of the roadmaps
constexpr std::size_t kMostRegions = 4;  // that are kept, of a map in pieces
constexpr double kMoreTime = 1.25;       // for paths past what moves
// Shares of the planning time by which searches for paths end: the rest is for optimising them.
constexpr double kSamples = 0.25;
constexpr double kPaths = 0.5;
constexpr double kStaticPlans = 0.6;  // where there is something that moves
constexpr double kMovingSamples = 0.7;
constexpr double kMovingPaths = 0.8;

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
    if (kept.empty() || (!has_class(kept, candidate.signature) && has_curve(candidate)))
      kept.push_back(std::move(candidate));
  }
  candidates = std::move(kept);
}

std::string coordinates(const Eigen::Vector3d& p) {
  char text[96];
  std::snprintf(text, sizeof text, "(%g, %g, %g)", p.x(), p.y(), p.z());
  return text;
}

}  // namespace

SpacePlanner::SpacePlanner(std::shared_ptr<const VoxelDistanceField> field,
                           const SpacePlannerOptions& options, std::function<double()> now_s)
    : field_(std::move(field)), options_(options), optimizer_(options), now_s_(std::move(now_s)) {}

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

SpacePathOptions SpacePlanner::path_options(const SpaceQuery& query,
                                            std::function<bool()> stop_sampling) const {
  return {{options_.required_clearance_m(), 0.0},
          query.classes > 0 ? query.classes : options_.classes,
          options_.longest_ratio,
          {options_.prm_samples, kSeed, options_.prm_reach_m, std::move(stop_sampling)}};
}

/// Paths past what moves, that take as long as the static plan, and a little longer.
std::vector<TimedSpacePath> SpacePlanner::paths_among_moving(const SpaceQuery& query,
                                                             const SpaceRegion& region,
                                                             const std::vector<SpacePath>& paths,
                                                             const Candidates& without,
                                                             const Past& past) const {
  double duration_s = 0.0;
  for (const SpaceCandidate& candidate : without) {
    if (has_curve(candidate)) duration_s = std::max(duration_s, candidate.curve.duration());
  }
  if (duration_s == 0.0) return {};
  MovingQuery moving{
      {query.start, query.goal, 0.0, kMoreTime * duration_s}, options_.max_speed, {}};
  for (const Tube<3>& tube : query.moving)
    moving.tubes.push_back(enlarged<3>(tube, options_.required_clearance_m()));
  return find_moving_paths(*field_, region, moving, paths,
                           path_options(query, past(kMovingSamples)), past(kMovingPaths));
}

void SpacePlanner::optimize_all(const std::vector<TimedSpacePath>& paths, const SpaceScene& scene,
                                const std::function<bool()>& should_stop,
                                Candidates& candidates) const {
  const std::size_t before = candidates.size();
  candidates.resize(before + paths.size());
  in_parallel(paths.size(), options_.threads, [&](std::size_t i) {
    candidates[before + i] = optimizer_.optimize_path(paths[i], scene, should_stop);
  });
}

/// Candidates of pairwise different classes, the best first.
SpacePlanner::Candidates SpacePlanner::find_candidates(const SpaceQuery& query,
                                                       const SpaceRegion& region,
                                                       const Past& past) const {
  const std::vector<SpacePath> paths = find_space_paths(
      *field_, region, query.start, query.goal, path_options(query, past(kSamples)), past(kPaths));
  const SpaceScene scene{*field_, region.cuts(), query.moving};
  std::vector<TimedSpacePath> untimed;
  for (const SpacePath& path : paths) untimed.push_back({path.points, {}});
  Candidates candidates;
  optimize_all(untimed, scene, past(query.moving.empty() ? 1.0 : kStaticPlans), candidates);
  if (!query.moving.empty()) {
    const auto timed = paths_among_moving(query, region, paths, candidates, past);
    optimize_all(timed, scene, past(1.0), candidates);
  }
  keep_best_of_each_class(candidates);
  return candidates;
}

SpacePlan SpacePlanner::plan(const SpaceQuery& query) {
  SpacePlan plan;
  if (is_refused(query, plan)) return plan;
  const auto region = region_of(query.start);
  const double begin_s = now_s_();
  std::atomic<bool> is_late = false;
  const Past past = [&](double share) {
    return [this, &query, &is_late, until_s = begin_s + share * options_.planning_time_s] {
      const bool is_over = query.should_stop() || now_s_() > until_s;
      if (is_over) is_late = true;
      return is_over;
    };
  };
  if (region) plan.candidates = find_candidates(query, *region, past);
  if (plan.candidates.empty()) {
    plan.reason = PlanReason::kNoPath;
    plan.message =
        "found no path from " + coordinates(query.start) + " to " + coordinates(query.goal);
  } else {
    plan.reason = plan.candidates.front().reason;
    plan.message = outcome(plan.candidates.front());
  }
  if (!plan.selected() && is_late) {
    plan.reason = PlanReason::kBudgetExhausted;
    plan.message = "out of time: " + plan.message;
  }
  plan.took_s = now_s_() - begin_s;
  return plan;
}

}  // namespace mocha
