#include "planning/executive/impediment_watch.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "planning/candidates/peer_discs.h"
#include "topology/paths/grid_path.h"
#include "world/obstacle.h"

namespace mocha {
namespace {

// Of standing: where it can only wait, and where there is a way that it may yet find.
constexpr double kPatience_s = 1.0;
constexpr double kPatienceWithWayRound_s = 4.0;
constexpr double kPeriod_s = 0.5;
constexpr double kLattice_m = 0.1;

bool passes(const std::vector<Vector2>& path, const BlockedDisc& disc) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vector2 nearest = nearest_on_segment(disc.centre, path[i - 1], path[i]);
    if ((disc.centre - nearest).norm() < disc.radius_m) return true;
  }
  return false;
}

}  // namespace

bool ImpedimentWatch::is_impeded(bool stands, const Vector2& here, const Vector2& goal,
                                 const PlanningScene& scene, const RobotModel& robot,
                                 const TravelOptions& travel, double now_s) {
  if (!stands) stands_since_s_.reset();
  if (stands && !stands_since_s_) stands_since_s_ = now_s;
  const double stood_s = stands ? now_s - *stands_since_s_ : 0.0;
  if (stood_s < kPatience_s && !is_impeded_) return false;
  if (now_s < looked_s_ + kPeriod_s) return is_impeded_;
  looked_s_ = now_s;
  std::vector<BlockedDisc> resting;
  for (const auto& peer : scene.peers)
    resting.push_back(peer_keep_out(*peer, peer->rest_time(), robot, 0.0));
  const auto way = [&](std::vector<BlockedDisc> blocked) {
    const TravelCost cost(*scene.static_map, here, std::move(blocked), travel);
    return find_grid_path(*scene.static_map, here, goal, cost, kLattice_m).points;
  };
  const std::vector<Vector2> shortest = way({});
  is_impeded_ = std::any_of(resting.begin(), resting.end(),
                            [&](const BlockedDisc& disc) { return passes(shortest, disc); }) &&
                (stood_s >= kPatienceWithWayRound_s || way(resting).empty());
  return is_impeded_;
}

}  // namespace mocha
