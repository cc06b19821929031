#include "ros/candidate_drawing.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>

namespace mocha {
namespace {

constexpr double kStep_m = 0.15;
constexpr int kLabelStride = 4;  // points between places that are tried for a label

const std::array<std_msgs::ColorRGBA, 8> kColors = {
    color(0.90, 0.10, 0.55), color(0.10, 0.45, 0.90), color(0.05, 0.60, 0.25),
    color(0.95, 0.55, 0.05), color(0.50, 0.20, 0.75), color(0.00, 0.65, 0.70),
    color(0.60, 0.35, 0.10), color(0.55, 0.55, 0.10)};

/// The same polyline with points `kStep_m` apart.
std::vector<Vector2> evenly(const std::vector<Vector2>& path) {
  std::vector<Vector2> points;
  double missing_m = 0.0;  // to the next point
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vector2 side = path[i] - path[i - 1];
    const double length_m = side.norm();
    for (; missing_m <= length_m && length_m > 0.0; missing_m += kStep_m)
      points.push_back(path[i - 1] + side * (missing_m / length_m));
    missing_m -= length_m;
  }
  if (!path.empty()) points.push_back(path.back());
  return points;
}

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
  return evenly(candidate.motion.empty() ? candidate.way : polyline(candidate.motion, kTimeStep_s));
}

void draw_candidates(const std::string& name, const std::vector<PlanCandidate>& candidates,
                     Drawing& drawing) {
  std::vector<std::vector<Vector2>> paths;
  for (const PlanCandidate& candidate : candidates) paths.push_back(drawn_path(candidate));
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (paths[i].empty()) continue;
    std_msgs::ColorRGBA own = kColors[i % kColors.size()];
    own.a = candidates[i].selected ? 1.0F : 0.7F;
    const bool dashed = candidates[i].reason != PlanReason::kSolved;
    drawing.add_line(name, paths[i], candidates[i].selected ? 0.07 : 0.035, own, dashed);
    drawing.add_label(name, label(candidates[i]), label_place(paths, i),
                      candidates[i].selected ? 0.35 : 0.22, own);
  }
}

}  // namespace mocha
