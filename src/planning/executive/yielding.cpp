#include "planning/executive/yielding.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "planning/candidates/peer_discs.h"
#include "planning/global/front_end.h"
#include "safety/requirement.h"
#include "world/obstacle.h"

namespace mocha {
namespace {

constexpr double kLapse_s = 2.0;    // of a request that is not heard any more
constexpr double kRoom_m = 0.15;    // about a pull-over point, so that the other finds its way past
constexpr double kSample_s = 0.2;   // of a motion that may meet
constexpr double kSample_m = 0.2;   // of the way that it may meet
constexpr double kEarlier_s = 1.0;  // the other may come by so much before it is expected
constexpr double kLattice_m = 0.1;
constexpr double kFarthest_m = 60.0;  // to a pull-over point
constexpr std::size_t kMostHeard = 250;

double distance_m(const Vector2& place, const std::vector<Vector2>& path) {
  double least_m =
      path.empty() ? std::numeric_limits<double>::infinity() : (place - path[0]).norm();
  for (std::size_t i = 1; i < path.size(); ++i)
    least_m = std::min(least_m, (place - nearest_on_segment(place, path[i - 1], path[i])).norm());
  return least_m;
}

/// How far along the way the first place is that comes so close [m]; none if there is none.
std::optional<double> first_close_m(const Vector2& place, const std::vector<Vector2>& path,
                                    double keep_m) {
  double begin_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vector2 along = path[i] - path[i - 1];
    const double length_m = along.norm();
    const Vector2 nearest = nearest_on_segment(place, path[i - 1], path[i]);
    if ((place - nearest).norm() < keep_m) {
      const int steps = static_cast<int>(length_m / kSample_m);
      for (int k = 0; k <= steps; ++k) {
        const double there_m = std::min(length_m, k * kSample_m);
        const Vector2 there = path[i - 1] + along * (length_m > 0.0 ? there_m / length_m : 0.0);
        if ((place - there).norm() < keep_m) return begin_m + there_m;
      }
      return begin_m + (nearest - path[i - 1]).norm();
    }
    begin_m += length_m;
  }
  return std::nullopt;
}

}  // namespace

Yielding::Yielding(Rank own, RobotModel robot, const PlannerOptions& options)
    : own_(std::move(own)),
      priority_(own_.priority),
      robot_(std::move(robot)),
      options_(homotopy_path_options(robot_, options)) {}

void Yielding::set_options(const PlannerOptions& options) {
  options_ = homotopy_path_options(robot_, options);
}

void Yielding::set_parked(bool parked) {
  own_.priority = parked ? std::numeric_limits<int>::min() : priority_;
}

void Yielding::hear(const YieldRequest& request, double now_s) {
  for (auto it = heard_.begin(); it != heard_.end();)
    it = now_s < it->second.until_s ? std::next(it) : heard_.erase(it);
  if (request.path.empty()) {
    heard_.erase(request.agent);
    return;
  }
  const bool has_room = heard_.size() < kMostHeard || heard_.count(request.agent) > 0;
  if (request.agent != own_.agent && has_room) heard_[request.agent] = {request, now_s + kLapse_s};
}

std::vector<const YieldRequest*> Yielding::above(double now_s) const {
  std::vector<const YieldRequest*> paths;
  for (const auto& [agent, heard] : heard_) {
    if (now_s < heard.until_s && outranks(heard.request.rank, own_))
      paths.push_back(&heard.request);
  }
  std::stable_sort(paths.begin(), paths.end(), [](const YieldRequest* a, const YieldRequest* b) {
    return outranks(a->rank, b->rank);
  });
  return paths;
}

double Yielding::keep_m(const YieldRequest& request) const {
  return request.radius_m + distance_to_peers_m(robot_);
}

std::optional<Rank> Yielding::in_way_of(const Vector2& place, double now_s) const {
  for (const YieldRequest* request : above(now_s)) {
    if (distance_m(place, request->path) < keep_m(*request)) return request->rank;
  }
  return std::nullopt;
}

bool Yielding::meets(const Motion& motion, const YieldRequest& request, double now_s) const {
  const double end_s = std::max(now_s, motion.end_time());
  for (double t = now_s; t < end_s; t += kSample_s) {
    const auto along_m = first_close_m(motion.position(t), request.path, keep_m(request));
    if (along_m && t - now_s > *along_m / request.speed_mps - kEarlier_s) return true;
  }
  return distance_m(motion.position(end_s), request.path) < keep_m(request);
}

std::optional<Rank> Yielding::in_way_of(const Motion& motion, double now_s) const {
  for (const YieldRequest* request : above(now_s)) {
    if (meets(motion, *request, now_s)) return request->rank;
  }
  return std::nullopt;
}

Yielding::PullOverChoice Yielding::best_pull_over_point(
    const std::vector<const YieldRequest*>& paths, const Vector2& from, const PlanningScene& scene,
    double now_s, bool around_all) const {
  const auto asks = [&](const std::string& name) {
    return std::any_of(paths.begin(), paths.end(), [&](const YieldRequest* request) {
      return request->agent == name || request->rank.agent == name;
    });
  };
  std::vector<BlockedDisc> blocked;
  for (const auto& peer : scene.peers) {
    const bool around = around_all && stands(*peer, now_s);
    if (around || asks(peer->name())) blocked.push_back(peer_keep_out(*peer, now_s, robot_, 0.0));
  }
  const TravelCost cost(*scene.static_map, from, std::move(blocked), options_.travel);
  PullOverChoice best;
  find_nearest_place(
      *scene.static_map, from, cost, kLattice_m, kFarthest_m, [&](const Vector2& place) {
        std::size_t spared = 0;
        while (spared < paths.size() &&
               distance_m(place, paths[spared]->path) >= keep_m(*paths[spared]) + kRoom_m)
          ++spared;
        if (spared > best.spared) best = {spared, place};
        return spared == paths.size();
      });
  return best;
}

std::optional<Vector2> Yielding::pull_over_point(const Vector2& from, const PlanningScene& scene,
                                                 double now_s) const {
  const auto paths = above(now_s);
  const PullOverChoice around = best_pull_over_point(paths, from, scene, now_s, true);
  if (around.spared == paths.size()) return around.place;
  const PullOverChoice through = best_pull_over_point(paths, from, scene, now_s, false);
  return through.spared > around.spared ? through.place : around.place;
}

std::vector<Vector2> Yielding::path(const Vector2& from, const Vector2& to,
                                    const PlanningScene& scene) const {
  const TravelCost cost(*scene.static_map, from, {}, options_.travel);
  return find_grid_path(*scene.static_map, from, to, cost, kLattice_m).points;
}

bool Yielding::is_near(const std::vector<Vector2>& path, const PlanningScene& scene, double now_s,
                       double more_m) const {
  return std::any_of(scene.peers.begin(), scene.peers.end(), [&](const auto& peer) {
    const BlockedDisc disc = peer_keep_out(*peer, now_s, robot_, more_m);
    return distance_m(disc.centre, path) < disc.radius_m;
  });
}

YieldRequest Yielding::request_for(const std::vector<Vector2>& path, const Rank& rank) const {
  YieldRequest request;
  request.agent = own_.agent;
  request.rank = rank;
  request.radius_m = robot_.footprint.circumscribed_radius_m();
  request.speed_mps = robot_.limits.max_speed;
  request.path = said_shortly(path);
  return request;
}

}  // namespace mocha
