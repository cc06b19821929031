#include "fleet/protocol/yield_request.h"

#include <stdexcept>

#include "world/obstacle.h"

namespace mocha {
namespace {

constexpr double kMaxRadius_m = 10.0;
constexpr double kMaxSpeed = 50.0;  // [m/s]
constexpr double kFinest_m = 0.02;  // of what is left out

void require(bool condition, const std::string& what) {
  if (!condition) throw std::invalid_argument("yield request: " + what);
}

/// Douglas and Peucker: marks what has to be kept between two places that are.
void keep_between(const std::vector<Vector2>& path, std::size_t first, std::size_t last,
                  double tolerance_m, std::vector<bool>& kept) {
  double farthest_m = tolerance_m;
  std::size_t farthest = first;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double off_m = (path[i] - nearest_on_segment(path[i], path[first], path[last])).norm();
    if (off_m <= farthest_m) continue;
    farthest_m = off_m;
    farthest = i;
  }
  if (farthest == first) return;
  kept[farthest] = true;
  keep_between(path, first, farthest, tolerance_m, kept);
  keep_between(path, farthest, last, tolerance_m, kept);
}

}  // namespace

bool outranks(const Rank& a, const Rank& b) {
  if (a.stuck != b.stuck) return a.stuck;
  return a.priority != b.priority ? a.priority > b.priority : a.agent < b.agent;
}

void validate(const YieldRequest& request) {
  require(!request.agent.empty() && !request.rank.agent.empty(), "has no name of a robot");
  require(request.path.size() <= kMostPathPlaces,
          "has " + std::to_string(request.path.size()) + " places, allowed are 64");
  for (const Vector2& place : request.path) require(place.allFinite(), "a place is not finite");
  require(request.radius_m > 0.0 && request.radius_m <= kMaxRadius_m,
          "radius = " + std::to_string(request.radius_m) + " m, allowed is above 0 up to 10 m");
  require(request.speed_mps > 0.0 && request.speed_mps <= kMaxSpeed,
          "speed = " + std::to_string(request.speed_mps) + " m/s, allowed is above 0 up to 50 m/s");
}

std::vector<Vector2> said_shortly(const std::vector<Vector2>& path) {
  if (path.size() < 2) return path;
  std::vector<Vector2> few;
  for (double tolerance_m = kFinest_m;; tolerance_m *= 2.0) {
    std::vector<bool> kept(path.size(), false);
    kept.front() = kept.back() = true;
    keep_between(path, 0, path.size() - 1, tolerance_m, kept);
    few.clear();
    for (std::size_t i = 0; i < path.size(); ++i) {
      if (kept[i]) few.push_back(path[i]);
    }
    if (few.size() <= kMostPathPlaces) return few;
  }
}

}  // namespace mocha
