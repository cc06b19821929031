#include "perception/mapping/zone_exit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <unordered_map>
#include <utility>

namespace mocha {
namespace {

constexpr double kStep_m = 0.1;  // of the lattice
constexpr int kReach = 300;      // steps

using Place = Eigen::Vector2i;

std::int64_t key(const Place& at) { return std::int64_t{at.y()} * (4 * kReach) + at.x(); }

bool is_outside(const std::vector<Polygon>& areas, const Vector2& place, double distance_m) {
  return std::all_of(areas.begin(), areas.end(), [&](const Polygon& area) {
    return gap(place, area).distance_m >= distance_m;
  });
}

/// Dijkstra's search on a lattice about `from`; empty where nothing outside is found.
template <typename MayPass>
std::vector<Vector2> shortest_exit(const std::vector<Polygon>& areas, const Vector2& from,
                                   double half_width_m, const MayPass& may_pass) {
  struct Node {
    double way_m = std::numeric_limits<double>::infinity();
    Place before{0, 0};
    bool done = false;
  };
  using Entry = std::pair<double, std::array<int, 2>>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  std::unordered_map<std::int64_t, Node> nodes;
  const auto place_of = [&](const Place& at) -> Vector2 {
    return from + kStep_m * at.cast<double>();
  };
  nodes[key({0, 0})].way_m = 0.0;
  open.push({0.0, {0, 0}});
  while (!open.empty()) {
    const Place at(open.top().second[0], open.top().second[1]);
    open.pop();
    Node& node = nodes[key(at)];
    if (std::exchange(node.done, true)) continue;
    if (is_outside(areas, place_of(at), half_width_m)) {
      std::vector<Vector2> path;
      for (Place back = at; !back.isZero(); back = nodes[key(back)].before)
        path.push_back(place_of(back));
      std::reverse(path.begin(), path.end());
      return path;
    }
    const double way_m = node.way_m;
    for (const Place& step : {Place(1, 0), Place(-1, 0), Place(0, 1), Place(0, -1), Place(1, 1),
                              Place(1, -1), Place(-1, 1), Place(-1, -1)}) {
      const Place next = at + step;
      if (next.cwiseAbs().maxCoeff() > kReach || !may_pass(place_of(next))) continue;
      Node& other = nodes[key(next)];
      const double there_m = way_m + kStep_m * step.cast<double>().norm();
      if (there_m >= other.way_m) continue;
      other.way_m = there_m;
      other.before = at;
      open.push({there_m, {next.x(), next.y()}});
    }
  }
  return {};
}

}  // namespace

bool Strip::covers(const Vector2& place) const {
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vector2 near = nearest_on_segment(place, path[i > 0 ? i - 1 : 0], path[i]);
    if ((place - near).squaredNorm() < half_width_m * half_width_m) return true;
  }
  return false;
}

Strip find_exit(const std::vector<Polygon>& areas, const OccupancyMap& map,
                const std::vector<Vector2>& course, const ExitRoom& room) {
  Strip strip{course, room.half_width_m};
  const auto is_free = [&](const Vector2& place, double room_m) {
    return !map.is_occupied_within(place, room_m, false);
  };
  const auto is_seen = [&](const Vector2& place) {
    return is_free(place, room.body_m) && !map.is_unknown_within(place, map.options().resolution_m);
  };
  const auto search = [&](const auto& may_pass) {
    return shortest_exit(areas, course.back(), room.half_width_m, may_pass);
  };
  std::vector<Vector2> way = search(is_seen);
  for (const double room_m : {room.body_m, room.least_m}) {
    if (way.empty()) way = search([&](const Vector2& place) { return is_free(place, room_m); });
  }
  strip.path.insert(strip.path.end(), way.begin(), way.end());
  return strip;
}

}  // namespace mocha
