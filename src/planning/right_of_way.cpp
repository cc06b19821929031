#include "planning/right_of_way.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "planning/front_end.h"
#include "planning/peer_discs.h"
#include "world/obstacle.h"

namespace mocha {
namespace {

constexpr double kLapse_s = 2.0;    // of a request that is not heard any more
constexpr double kRoom_m = 0.15;    // about a refuge, so that the other finds its way past
constexpr double kSample_s = 0.2;   // of a motion that may meet
constexpr double kSample_m = 0.2;   // of the way that it may meet
constexpr double kEarlier_s = 1.0;  // the other may come by so much before it is expected
constexpr double kLattice_m = 0.1;
constexpr double kFarthest_m = 60.0;  // to a refuge
constexpr std::size_t kMostHeard = 250;

double distance_m(const Vector2& place, const std::vector<Vector2>& way) {
  double least_m = way.empty() ? std::numeric_limits<double>::infinity() : (place - way[0]).norm();
  for (std::size_t i = 1; i < way.size(); ++i)
    least_m = std::min(least_m, (place - nearest_on_segment(place, way[i - 1], way[i])).norm());
  return least_m;
}

/// How far along the way the first place is that comes so close [m]; none if there is none.
std::optional<double> first_close_m(const Vector2& place, const std::vector<Vector2>& way,
                                    double keep_m) {
  double begin_m = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Vector2 along = way[i] - way[i - 1];
    const double length_m = along.norm();
    const Vector2 nearest = nearest_on_segment(place, way[i - 1], way[i]);
    if ((place - nearest).norm() < keep_m) {
      const int steps = static_cast<int>(length_m / kSample_m);
      for (int k = 0; k <= steps; ++k) {
        const double there_m = std::min(length_m, k * kSample_m);
        const Vector2 there = way[i - 1] + along * (length_m > 0.0 ? there_m / length_m : 0.0);
        if ((place - there).norm() < keep_m) return begin_m + there_m;
      }
      return begin_m + (nearest - way[i - 1]).norm();
    }
    begin_m += length_m;
  }
  return std::nullopt;
}

}  // namespace

RightOfWay::RightOfWay(Rank own, RobotModel robot, const PlannerRules& rules)
    : own_(std::move(own)),
      priority_(own_.priority),
      robot_(std::move(robot)),
      rules_(way_rules(robot_, rules)) {}

void RightOfWay::set_rules(const PlannerRules& rules) { rules_ = way_rules(robot_, rules); }

void RightOfWay::set_parked(bool parked) {
  own_.priority = parked ? std::numeric_limits<int>::min() : priority_;
}

void RightOfWay::hear(const WayRequest& request, double now_s) {
  for (auto it = heard_.begin(); it != heard_.end();)
    it = now_s < it->second.until_s ? std::next(it) : heard_.erase(it);
  if (request.way.empty()) {
    heard_.erase(request.agent);
    return;
  }
  const bool has_room = heard_.size() < kMostHeard || heard_.count(request.agent) > 0;
  if (request.agent != own_.agent && has_room) heard_[request.agent] = {request, now_s + kLapse_s};
}

std::vector<const WayRequest*> RightOfWay::above(double now_s) const {
  std::vector<const WayRequest*> ways;
  for (const auto& [agent, heard] : heard_) {
    if (now_s < heard.until_s && outranks(heard.request.rank, own_)) ways.push_back(&heard.request);
  }
  std::stable_sort(ways.begin(), ways.end(), [](const WayRequest* a, const WayRequest* b) {
    return outranks(a->rank, b->rank);
  });
  return ways;
}

double RightOfWay::keep_m(const WayRequest& request) const {
  return request.radius_m + distance_to_peers_m(robot_);
}

std::optional<Rank> RightOfWay::in_way_of(const Vector2& place, double now_s) const {
  for (const WayRequest* request : above(now_s)) {
    if (distance_m(place, request->way) < keep_m(*request)) return request->rank;
  }
  return std::nullopt;
}

bool RightOfWay::meets(const Motion& motion, const WayRequest& request, double now_s) const {
  const double end_s = std::max(now_s, motion.end_time());
  for (double t = now_s; t < end_s; t += kSample_s) {
    const auto along_m = first_close_m(motion.position(t), request.way, keep_m(request));
    if (along_m && t - now_s > *along_m / request.speed_mps - kEarlier_s) return true;
  }
  return distance_m(motion.position(end_s), request.way) < keep_m(request);
}

std::optional<Rank> RightOfWay::in_way_of(const Motion& motion, double now_s) const {
  for (const WayRequest* request : above(now_s)) {
    if (meets(motion, *request, now_s)) return request->rank;
  }
  return std::nullopt;
}

RightOfWay::Refuge RightOfWay::best_refuge(const std::vector<const WayRequest*>& ways,
                                           const Vector2& from, const PlanningScene& scene,
                                           double now_s, bool around_all) const {
  const auto asks = [&](const std::string& name) {
    return std::any_of(ways.begin(), ways.end(), [&](const WayRequest* request) {
      return request->agent == name || request->rank.agent == name;
    });
  };
  std::vector<BlockedDisc> blocked;
  for (const auto& peer : scene.peers) {
    const bool around = around_all && stands(*peer, now_s);
    if (around || asks(peer->name())) blocked.push_back(kept_from(*peer, now_s, robot_, 0.0));
  }
  const TravelCost cost(*scene.terrain, from, std::move(blocked), rules_.travel);
  Refuge best;
  find_nearest_place(
      *scene.terrain, from, cost, kLattice_m, kFarthest_m, [&](const Vector2& place) {
        std::size_t spared = 0;
        while (spared < ways.size() &&
               distance_m(place, ways[spared]->way) >= keep_m(*ways[spared]) + kRoom_m)
          ++spared;
        if (spared > best.spared) best = {spared, place};
        return spared == ways.size();
      });
  return best;
}

std::optional<Vector2> RightOfWay::refuge(const Vector2& from, const PlanningScene& scene,
                                          double now_s) const {
  const auto ways = above(now_s);
  const Refuge around = best_refuge(ways, from, scene, now_s, true);
  if (around.spared == ways.size()) return around.place;
  const Refuge through = best_refuge(ways, from, scene, now_s, false);
  return through.spared > around.spared ? through.place : around.place;
}

std::vector<Vector2> RightOfWay::way(const Vector2& from, const Vector2& to,
                                     const PlanningScene& scene) const {
  const TravelCost cost(*scene.terrain, from, {}, rules_.travel);
  return find_grid_path(*scene.terrain, from, to, cost, kLattice_m).points;
}

bool RightOfWay::is_near(const std::vector<Vector2>& way, const PlanningScene& scene, double now_s,
                         double more_m) const {
  return std::any_of(scene.peers.begin(), scene.peers.end(), [&](const auto& peer) {
    const BlockedDisc disc = kept_from(*peer, now_s, robot_, more_m);
    return distance_m(disc.centre, way) < disc.radius_m;
  });
}

WayRequest RightOfWay::request_for(const std::vector<Vector2>& way, const Rank& rank) const {
  WayRequest request;
  request.agent = own_.agent;
  request.rank = rank;
  request.radius_m = robot_.footprint.circumscribed_radius_m();
  request.speed_mps = robot_.limits.max_speed;
  request.way = said_shortly(way);
  return request;
}

}  // namespace mocha
