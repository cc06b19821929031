#include "planning/right_of_way.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "planning/front_end.h"
#include "planning/peer_discs.h"

namespace mocha {
namespace {

constexpr double kLapse_s = 2.0;       // a request that is not heard any more
constexpr double kRoom_m = 0.15;       // of a refuge, so that the other finds its way past
constexpr double kSample_s = 0.2;      // of a motion that may meet
constexpr double kSample_m = 0.2;      // of the way that it may meet
constexpr double kEarlier_s = 1.0;     // the other may come by so much before it is expected
constexpr double kLattice_m = 0.1;

double distance_m(const Vector2& place, const Vector2& a, const Vector2& b) {
  const Vector2 along = b - a;
  const double length2 = along.squaredNorm();
  const double share =
      length2 > 0.0 ? std::clamp((place - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (place - a - share * along).norm();
}

double distance_m(const Vector2& place, const std::vector<Vector2>& way) {
  double least_m = way.empty() ? std::numeric_limits<double>::infinity() : (place - way[0]).norm();
  for (std::size_t i = 1; i < way.size(); ++i)
    least_m = std::min(least_m, distance_m(place, way[i - 1], way[i]));
  return least_m;
}

/// How far along the way the last place is that comes so close [m]; negative if none does.
double reached_along_m(const Vector2& place, const std::vector<Vector2>& way, double keep_m) {
  double first_m = -1.0;
  double begin_m = 0.0;
  for (std::size_t i = 0; i < way.size() && first_m < 0.0; ++i) {
    const Vector2& a = way[i];
    const Vector2& b = way[std::min(i + 1, way.size() - 1)];
    const double length_m = (b - a).norm();
    if (distance_m(place, a, b) < keep_m) {
      const int steps = 1 + static_cast<int>(length_m / kSample_m);
      for (int k = 0; k <= steps && first_m < 0.0; ++k) {
        const double share = static_cast<double>(k) / steps;
        if ((place - a - share * (b - a)).norm() < keep_m) first_m = begin_m + share * length_m;
      }
    }
    begin_m += length_m;
  }
  return first_m;
}

}  // namespace

RightOfWay::RightOfWay(Rank own, RobotModel robot, const PlannerRules& rules)
    : own_(std::move(own)), robot_(std::move(robot)), rules_(way_rules(robot_, rules)) {}

void RightOfWay::set_rules(const PlannerRules& rules) { rules_ = way_rules(robot_, rules); }

void RightOfWay::hear(const WayRequest& request, double now_s) {
  if (request.agent == own_.agent) return;
  if (request.way.empty()) {
    heard_.erase(request.agent);
  } else {
    heard_[request.agent] = {request, now_s + kLapse_s};
  }
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

bool RightOfWay::in_the_way(const Vector2& place, double now_s) const {
  const auto ways = above(now_s);
  return std::any_of(ways.begin(), ways.end(), [&](const WayRequest* request) {
    return distance_m(place, request->way) < keep_m(*request);
  });
}

bool RightOfWay::meets(const Motion& motion, double now_s) const {
  const double end_s = motion.end_time();
  for (const WayRequest* request : above(now_s)) {
    for (double t = now_s; t < end_s + kSample_s; t += kSample_s) {
      const Vector2 place = motion.position(std::min(t, end_s));
      const double along_m = reached_along_m(place, request->way, keep_m(*request));
      if (along_m < 0.0) continue;
      const double comes_s = now_s + along_m / request->speed_mps - kEarlier_s;
      if (t >= end_s || t > comes_s) return true;
    }
  }
  return false;
}

std::optional<Vector2> RightOfWay::refuge_from(const std::vector<const WayRequest*>& ways,
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
  const GridPath path =
      find_nearest_place(*scene.terrain, from, cost, kLattice_m, [&](const Vector2& place) {
        return std::all_of(ways.begin(), ways.end(), [&](const WayRequest* request) {
          return distance_m(place, request->way) >= keep_m(*request) + kRoom_m;
        });
      });
  if (path.points.empty()) return std::nullopt;
  return path.points.back();
}

std::optional<Vector2> RightOfWay::refuge(const Vector2& from, const PlanningScene& scene,
                                          double now_s) {
  for (auto ways = above(now_s); !ways.empty(); ways.pop_back()) {
    for (const bool around_all : {true, false}) {
      if (const auto place = refuge_from(ways, from, scene, now_s, around_all)) return place;
    }
  }
  own_.stuck = true;
  return std::nullopt;
}

std::vector<Vector2> RightOfWay::way(const Vector2& from, const Vector2& to,
                                     const PlanningScene& scene) const {
  const TravelCost cost(*scene.terrain, from, {}, rules_.travel);
  return find_grid_path(*scene.terrain, from, to, cost, kLattice_m).points;
}

bool RightOfWay::blocked(const std::vector<Vector2>& way, const PlanningScene& scene,
                         double now_s) const {
  return std::any_of(scene.peers.begin(), scene.peers.end(), [&](const auto& peer) {
    const BlockedDisc disc = kept_from(*peer, now_s, robot_, 0.0);
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
