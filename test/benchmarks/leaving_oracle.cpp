#include "benchmarks/leaving_oracle.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <queue>
#include <stdexcept>
#include <unordered_set>
#include <vector>

#include "trajectory/frame_change.h"

namespace mocha {
namespace {

constexpr double kKept_m = 0.002;   // by the body from every wall
constexpr double kCheck_m = 0.004;  // swept between two looks: nothing is touched in between
constexpr double kCell_m = 0.01;
constexpr double kCell_rad = 1.5 * M_PI / 180.0;
constexpr double kStep_m = 0.015;
constexpr double kOut_m = 0.05;  // more than it needs to turn about
constexpr std::size_t kMostCells = 1000000;
const std::vector<double> kCurvatures = {0.0, 1.0, -1.0, 3.0, -3.0, 8.0, -8.0};  // [1/m]

/// A short arc: `length_m` negative is backward, 0 a turn in place.
struct Move {
  double length_m;
  double turn_rad;
};

/// Arcs as chords: both are the same within what is swept between two looks.
Pose moved(const Pose& pose, const Move& move, double share) {
  const double course = pose.yaw_rad + 0.5 * share * move.turn_rad;
  return {pose.position + share * move.length_m * Vector2(std::cos(course), std::sin(course)),
          pose.yaw_rad + share * move.turn_rad};
}

/// Floods cells of (x, y, yaw), those nearer to the goal first; each is entered once.
class Flood {
 public:
  explicit Flood(const World& world)
      : world_(world),
        robot_(world.robots.at(0)),
        reach_m_(robot_.model.footprint.circumscribed_radius_m()) {
    for (const double sign : {1.0, -1.0}) {
      moves_.push_back({0.0, sign * kCell_rad});
      if (sign < 0.0 && !robot_.model.limits.can_reverse) continue;
      for (const double curvature : kCurvatures)
        moves_.push_back({sign * kStep_m, sign * kStep_m * curvature});
    }
  }

  Leavable run() {
    if (!is_free(robot_.start)) return Leavable::kTouches;
    add(robot_.start);
    while (!open_.empty()) {
      const Pose pose = poses_[open_.top().index];
      open_.pop();
      if (distance_m(pose.position) > reach_m_ + kOut_m) return Leavable::kYes;
      for (const Move& move : moves_) {
        const Pose next = moved(pose, move, 1.0);
        if (seen_.count(key(next)) == 0 && is_clear(pose, move)) add(next);
      }
      if (poses_.size() > kMostCells)
        throw std::runtime_error("leavable: more cells than can be searched");
    }
    return Leavable::kNo;
  }

 private:
  struct Entry {
    double left_m;
    std::size_t index;
    bool operator<(const Entry& other) const { return left_m > other.left_m; }
  };

  void add(const Pose& pose) {
    if (!seen_.insert(key(pose)).second) return;
    open_.push({(pose.position - robot_.goal->position).norm(), poses_.size()});
    poses_.push_back(pose);
  }

  std::uint64_t key(const Pose& pose) const {
    const Vector2 off = pose.position - robot_.start.position;
    const auto bits = [](double value, double cell, int shift) {
      return (static_cast<std::uint64_t>(std::llround(value / cell)) & 0x1fffff) << shift;
    };
    return bits(off.x(), kCell_m, 0) | bits(off.y(), kCell_m, 21) |
           bits(wrap_angle(pose.yaw_rad), kCell_rad, 42);
  }

  bool is_clear(const Pose& from, const Move& move) const {
    const double sweep_m = std::abs(move.length_m) + reach_m_ * std::abs(move.turn_rad);
    const int looks = std::max(1, static_cast<int>(std::ceil(sweep_m / kCheck_m)));
    for (int i = 1; i <= looks; ++i) {
      if (!is_free(moved(from, move, static_cast<double>(i) / looks))) return false;
    }
    return true;
  }

  bool is_free(const Pose& pose) const {
    const Obstacle body = placed(robot_.model.footprint, pose);
    return std::all_of(world_.polygons.begin(), world_.polygons.end(), [&](const Polygon& wall) {
      return gap(pose.position, wall).distance_m > reach_m_ + kKept_m ||
             gap(body, wall).distance_m > kKept_m;
    });
  }

  double distance_m(const Vector2& place) const {
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const Polygon& wall : world_.polygons)
      nearest_m = std::min(nearest_m, gap(place, wall).distance_m);
    return nearest_m;
  }

  const World& world_;
  const WorldRobot& robot_;
  const double reach_m_;
  std::vector<Move> moves_;
  std::vector<Pose> poses_;
  std::priority_queue<Entry> open_;
  std::unordered_set<std::uint64_t> seen_;
};

}  // namespace

Leavable leavable(const World& world) { return Flood(world).run(); }

}  // namespace mocha
