#include "planning/passing/place_graph.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <utility>

#include "fleet/protocol/passing_messages.h"
#include "planning/passing/few_places.h"
#include "planning/passing/place_packing.h"
#include "topology/paths/path_shortcutting.h"
#include "topology/static_map/lattice.h"
#include "trajectory/polyline.h"
#include "world/obstacle.h"

namespace mocha {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSame_m = 1e-3;
constexpr double kSamePlace_m = 0.02;
constexpr double kEnoughRoom_m = 0.2;  // beyond what robots have to keep
constexpr double kNextNode = 1.5;      // times the lattice: also the diagonal ones
constexpr double kAroundStart = 1.6;   // times what robots keep: the neighbours of a start
const Vector2 kFarAway(1e6, 1e6);      // no robot leaves a wall or a disc that it is in

/// Nodes by their distance, nearest first.
using NearestFirst = std::priority_queue<std::pair<double, int>,
                                         std::vector<std::pair<double, int>>, std::greater<>>;

using Paths = std::map<std::pair<int, int>, std::vector<Vector2>>;  // by their two places

/// The lattice within a window, and how far each of its nodes is from the nearest of some places.
class Surroundings {
 public:
  Surroundings(const PassingGround& ground, const Eigen::AlignedBox2d& window,
               const PlaceGraphOptions& options)
      : window_(window),
        lattice_(ground.static_map, options.lattice_m),
        cost_(ground.static_map, kFarAway, ground.blocked, without_escape(options.travel)),
        walls_(ground.static_map.field()),
        unseen_(ground.unseen),
        clearance_m_(options.travel.required_clearance_m) {}

  /// Grows from all places at once, as far as `most_m`; what they reach is nearest to the place
  /// `owner`.
  void grow(const std::vector<Vector2>& places, double most_m = kInfinity) {
    reached_m_.assign(lattice_.size(), kInfinity);
    owner_.assign(lattice_.size(), -1);
    parent_.assign(lattice_.size(), -1);
    NearestFirst queue;
    for (int i = 0; i < static_cast<int>(places.size()); ++i) enter(places[i], i, queue);
    while (!queue.empty()) {
      const auto [reached_m, node] = queue.top();
      queue.pop();
      if (reached_m > reached_m_[node]) continue;
      lattice_.visit_neighbours(node, [&](int next, double length_m) {
        if (reached_m + length_m > most_m || !joined(node, next)) return;
        if (!improve(next, reached_m + length_m, owner_[node], node)) return;
        queue.emplace(reached_m + length_m, next);
      });
    }
  }

  /// All that was reached of the ground that was seen. Behind a wall of which only the other side
  /// is known, there is more of it.
  std::vector<Vector2> reached_and_seen() const {
    std::vector<Vector2> found;
    for (int node = 0; node < static_cast<int>(lattice_.size()); ++node) {
      const Vector2 place = lattice_.position(node);
      if (owner_[node] >= 0 && room_m(place) >= 0.0) found.push_back(place);
    }
    return found;
  }

  /// How much farther it is from walls, and from what was not seen, than robots have to keep.
  double room_m(const Vector2& place) const {
    const double to_unseen_m = unseen_ != nullptr ? unseen_->distance_bound(place) : kInfinity;
    return std::min(walls_.distance_bound(place), to_unseen_m) - clearance_m_;
  }

  /// The shortest path to `place` from the one that the surroundings have grown from; empty where
  /// they did not reach it.
  std::vector<Vector2> path_from(const Vector2& start, const Vector2& place) const {
    int nearest = -1;
    double least_m = kInfinity;
    for (int which = 0; which < 4; ++which) {
      const int node = lattice_.corner(place, which);
      const double length_m = reached_m_[node] + (lattice_.position(node) - place).norm();
      if (!(length_m < least_m)) continue;
      least_m = length_m;
      nearest = node;
    }
    if (nearest < 0) return {};
    std::vector<Vector2> path = traced(nearest, start);
    std::reverse(path.begin(), path.end());
    if ((path.back() - place).norm() > kSame_m) path.push_back(place);
    path.back() = place;
    return shortened(path);
  }

  /// The shortest path between each two places of which the surroundings meet, through where they
  /// do.
  Paths paths(const std::vector<Vector2>& places) const {
    struct Meeting {
      double length_m = kInfinity;
      int here = -1;
      int there = -1;
    };
    std::map<std::pair<int, int>, Meeting> meetings;
    for (int node = 0; node < static_cast<int>(lattice_.size()); ++node) {
      if (owner_[node] < 0) continue;
      lattice_.visit_neighbours(node, [&](int next, double length_m) {
        if (owner_[next] <= owner_[node] || !joined(node, next)) return;
        Meeting& meeting = meetings[{owner_[node], owner_[next]}];
        const double through_m = reached_m_[node] + length_m + reached_m_[next];
        if (through_m < meeting.length_m) meeting = {through_m, node, next};
      });
    }
    Paths paths;
    for (const auto& [pair, meeting] : meetings) {
      std::vector<Vector2> path = traced(meeting.here, places[pair.first]);
      std::reverse(path.begin(), path.end());
      const std::vector<Vector2> rest = traced(meeting.there, places[pair.second]);
      path.insert(path.end(), rest.begin(), rest.end());
      paths[pair] = shortened(path);
    }
    return paths;
  }

 private:
  static TravelOptions without_escape(TravelOptions options) {
    options.escape_radius_m = 0.0;
    return options;
  }

  std::vector<Vector2> shortened(const std::vector<Vector2>& path) const {
    return few_places(with_shortcuts(path, cost_, Cuts<2>({})), kMostTurnPlaces);
  }

  bool is_free(int node) const {
    const Vector2 place = lattice_.position(node);
    return window_.contains(place) && cost_.at(place) < kInfinity;
  }

  bool joined(int a, int b) const {
    return is_free(b) && cost_.of_line(lattice_.position(a), lattice_.position(b)) < kInfinity;
  }

  /// By the corners of the square that it is in, whatever is between: robots may stand anywhere.
  void enter(const Vector2& place, int number, NearestFirst& queue) {
    for (int which = 0; which < 4; ++which) {
      const int node = lattice_.corner(place, which);
      const double length_m = (lattice_.position(node) - place).norm();
      if (is_free(node) && improve(node, length_m, number, node)) queue.emplace(length_m, node);
    }
  }

  bool improve(int node, double reached_m, int owner, int parent) {
    if (!(reached_m < reached_m_[node])) return false;
    reached_m_[node] = reached_m;
    owner_[node] = owner;
    parent_[node] = parent;
    return true;
  }

  /// From a node back to its place.
  std::vector<Vector2> traced(int node, const Vector2& place) const {
    std::vector<Vector2> path = {lattice_.position(node)};
    for (; parent_[node] != node; node = parent_[node])
      path.push_back(lattice_.position(parent_[node]));
    if ((path.back() - place).norm() < kSame_m) path.pop_back();
    path.push_back(place);
    return path;
  }

  const Eigen::AlignedBox2d window_;
  const Lattice lattice_;
  const TravelCost cost_;
  const ObstacleField<2>& walls_;
  const ObstacleField<2>* const unseen_;
  const double clearance_m_;
  std::vector<double> reached_m_;
  std::vector<int> owner_;
  std::vector<int> parent_;  // towards the place; itself beside it
};

double distance_m(const Vector2& place, const std::vector<Vector2>& path) {
  double least_m = (place - path.front()).norm();
  for (std::size_t i = 1; i < path.size(); ++i)
    least_m = std::min(least_m, (place - nearest_on_segment(place, path[i - 1], path[i])).norm());
  return least_m;
}

/// What is too close to where the robot begins is in its way only if it comes closer still.
PlaceSet blocking(const std::vector<Vector2>& places, int from, int to,
                  const std::vector<Vector2>& path, double apart_m) {
  PlaceSet blocking;
  for (int i = 0; i < static_cast<int>(places.size()); ++i) {
    const double keep_m = std::min(apart_m, (places[i] - places[from]).norm()) - kSame_m;
    const bool in_the_way = distance_m(places[i], path) < keep_m;
    if (i == to || (i != from && in_the_way)) blocking.insert(i);
  }
  return blocking;
}

/// To all places that are near.
void add_paths_from(int start, const std::vector<Vector2>& places, double most_m,
                    Surroundings& surroundings, Paths& paths) {
  surroundings.grow({places[start]}, most_m);
  for (int place = 0; place < static_cast<int>(places.size()); ++place) {
    const bool known = paths.count({place, start}) > 0;
    if (place == start || known || (places[place] - places[start]).norm() > most_m) continue;
    std::vector<Vector2> path = surroundings.path_from(places[start], places[place]);
    if (!path.empty()) paths[{start, place}] = std::move(path);
  }
}

void add_moves(const Paths& paths, double apart_m, PlaceGraph& graph) {
  graph.moves.resize(graph.places.size());
  for (const auto& [pair, path] : paths) {
    const auto [a, b] = pair;
    const double length_m = length_of(path);
    const std::vector<Vector2> back(path.rbegin(), path.rend());
    graph.moves[a].push_back({b, length_m, path, blocking(graph.places, a, b, path, apart_m)});
    graph.moves[b].push_back({a, length_m, back, blocking(graph.places, b, a, back, apart_m)});
  }
}

/// The goals, and as many places as there is room for, away from the walls if they can; where a
/// robot starts at one of them, that does for both.
std::vector<Vector2> with_more(const FixedPlaces& fixed, const Surroundings& surroundings,
                               const PlaceGraphOptions& options) {
  std::vector<Vector2> places = fixed.goals;
  const std::vector<Vector2> candidates = surroundings.reached_and_seen();
  std::vector<double> room_m;
  for (const Vector2& place : candidates)
    room_m.push_back(std::min(surroundings.room_m(place), kEnoughRoom_m));
  const auto chosen = settled(packed(candidates, places, options.apart_m), candidates, room_m,
                              places, options.apart_m, kNextNode * options.lattice_m);
  for (const int i : chosen) {
    const bool is_start = std::any_of(
        fixed.starts.begin(), fixed.starts.end(),
        [&](const Vector2& start) { return (start - candidates[i]).norm() < kSamePlace_m; });
    if (!is_start) places.push_back(candidates[i]);
  }
  return places;
}

}  // namespace

PlaceGraph make_place_graph(const PassingGround& ground, const Eigen::AlignedBox2d& window,
                            const FixedPlaces& fixed, const PlaceGraphOptions& options) {
  Surroundings surroundings(ground, window, options);
  PlaceGraph graph;
  graph.places = fixed.goals;
  graph.places.insert(graph.places.end(), fixed.starts.begin(), fixed.starts.end());
  surroundings.grow(graph.places);
  const std::vector<Vector2> lasting = with_more(fixed, surroundings, options);
  graph.places.insert(graph.places.end(), lasting.begin() + fixed.goals.size(), lasting.end());
  const int goals = static_cast<int>(fixed.goals.size());
  const int starts = static_cast<int>(fixed.starts.size());
  const auto number = [&](int place) { return place < goals ? place : place + starts; };
  Paths paths;
  surroundings.grow(lasting);
  for (auto& [pair, path] : surroundings.paths(lasting))
    paths[{number(pair.first), number(pair.second)}] = std::move(path);
  for (int start = goals; start < goals + starts; ++start)
    add_paths_from(start, graph.places, kAroundStart * options.apart_m, surroundings, paths);
  add_moves(paths, options.apart_m, graph);
  return graph;
}

std::vector<double> distances_to(const PlaceGraph& graph, int goal, double per_move_m) {
  std::vector<double> distances_m(graph.places.size(), kInfinity);
  distances_m[goal] = 0.0;
  NearestFirst queue;
  queue.emplace(0.0, goal);
  while (!queue.empty()) {
    const auto [reached_m, place] = queue.top();
    queue.pop();
    if (reached_m > distances_m[place]) continue;
    for (const PlaceMove& move : graph.moves[place]) {
      const double next_m = reached_m + move.length_m + per_move_m;
      if (!(next_m < distances_m[move.to])) continue;
      distances_m[move.to] = next_m;
      queue.emplace(distances_m[move.to], move.to);
    }
  }
  return distances_m;
}

}  // namespace mocha
