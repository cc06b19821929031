#include "ros_bridge/rviz/candidate_drawing.h"

#include <algorithm>
#include <cstdio>
#include <limits>

namespace mocha {
namespace {

constexpr int kLabelStride = 4;  // points between places that are tried for a label

double distance_m(const Vector2& p, const std::vector<Vector2>& path) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector2& point : path) least = std::min(least, (point - p).norm());
  return least;
}

/// The place on the path number `own` that is farthest from all others; near the middle, if alone.
Vector2 label_place(const std::vector<std::vector<Vector2>>& paths, std::size_t own) {
  const std::vector<Vector2>& path = paths[own];
  Vector2 best = path[path.size() / 2];
  double most_m = 0.0;
  for (std::size_t k = 0; k < path.size(); k += kLabelStride) {
    double apart_m = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < paths.size(); ++i) {
      if (i != own) apart_m = std::min(apart_m, distance_m(path[k], paths[i]));
    }
    if (apart_m <= most_m || apart_m == std::numeric_limits<double>::infinity()) continue;
    most_m = apart_m;
    best = path[k];
  }
  return best;
}

std::string label(const PlanCandidate& candidate) {
  char cost[32];
  std::snprintf(cost, sizeof(cost), "%.1f", candidate.cost);
  if (candidate.reason == PlanReason::kSolved) return cost;
  if (candidate.reason == PlanReason::kCannotWin) return std::string("> ") + cost;
  return candidate.violation ? describe(candidate.violation) : "not found";
}

}  // namespace

std::vector<Vector2> drawn_path(const PlanCandidate& candidate) {
  constexpr double kTimeStep_s = 0.1;
  return evenly(candidate.motion.empty() ? candidate.path
                                         : polyline(candidate.motion, kTimeStep_s));
}

void draw_candidates(const std::string& name, const std::vector<PlanCandidate>& candidates,
                     Drawing& drawing) {
  std::vector<std::vector<Vector2>> paths;
  for (const PlanCandidate& candidate : candidates) paths.push_back(drawn_path(candidate));
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (paths[i].empty()) continue;
    std_msgs::ColorRGBA own = class_color(i);
    own.a = candidates[i].selected ? 1.0F : 0.7F;
    const bool dashed = candidates[i].reason != PlanReason::kSolved;
    drawing.add_line(name, paths[i], candidates[i].selected ? 0.07 : 0.035, own, dashed);
    drawing.add_label(name, label(candidates[i]), label_place(paths, i),
                      candidates[i].selected ? 0.35 : 0.22, own);
  }
}

}  // namespace mocha
