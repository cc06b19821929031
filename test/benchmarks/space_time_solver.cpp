#include "benchmarks/space_time_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <queue>
#include <unordered_set>
#include <vector>

namespace mocha {
namespace {

constexpr double kStep_s = 0.5;
constexpr double kPush = 0.5;                                // [m/s^2]
constexpr double kUnit_m = 0.5 * kPush * kStep_s * kStep_s;  // of the lattice of positions
constexpr double kUnitSpeed = kPush * kStep_s;
constexpr int kChecks = 10;          // in one step
constexpr int kMergeUnits = 4;       // states this near are one
constexpr double kArriving_m = 1.0;  // from the goal, where each state counts
constexpr int kMostExpansions = 4000000;

constexpr int kLongestRest = 4;  // steps; after these, one may leave in any direction

/// Position, velocity and time in units of the lattice; of one that stands, its heading, in
/// eighths of a turn, and for how many steps.
struct State {
  int x, y, vx, vy, step;
  int heading = 0;
  int rest = 0;

  bool stands() const { return vx == 0 && vy == 0; }

  Vector2 place() const { return kUnit_m * Vector2(x, y); }
  Vector2 velocity() const { return kUnitSpeed * Vector2(vx, vy); }
  /// Direction of a velocity that one step leads to from rest.
  static int eighths(int vx, int vy) {
    return (static_cast<int>(std::lround(std::atan2(vy, vx) / (0.25 * M_PI))) + 8) % 8;
  }
  State pushed(int ax, int ay) const {
    State next{x + 2 * vx + ax, y + 2 * vy + ay, vx + ax, vy + ay, step + 1};
    if (!next.stands()) return next;
    next.heading = stands() ? heading : eighths(vx, vy);
    next.rest = stands() ? std::min(rest + 1, kLongestRest) : 0;
    return next;
  }
  /// The same for states within `units` of each other at one velocity and time.
  std::uint64_t key(int units) const {
    const auto merged = [&](int i) {
      return static_cast<std::uint64_t>((i + (1 << 14)) / units) & 0x7FFF;
    };
    return static_cast<std::uint64_t>(rest) << 57 | static_cast<std::uint64_t>(heading) << 54 |
           merged(x) << 39 | merged(y) << 24 | static_cast<std::uint64_t>(units) << 16 |
           static_cast<std::uint64_t>(vx + 8) << 12 | static_cast<std::uint64_t>(vy + 8) << 8 |
           static_cast<std::uint64_t>(step);
  }
};

/// Distances to the static obstacles, exact where it matters.
class Walls {
 public:
  Walls(const ReplanScene& scene, double keep_m) : scene_(scene), keep_m_(keep_m) {
    columns_ = 1 + static_cast<int>((scene.high.x() - scene.low.x()) / kUnit_m);
    rows_ = 1 + static_cast<int>((scene.high.y() - scene.low.y()) / kUnit_m);
    distances_m_.reserve(static_cast<std::size_t>(columns_) * rows_);
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        distances_m_.push_back(distance_m(scene.low + kUnit_m * Vector2(column, row)));
      }
    }
  }

  bool clear(const Vector2& place) const {
    const Vector2 cell = (place - scene_.low) / kUnit_m;
    const int column = static_cast<int>(std::lround(cell.x()));
    const int row = static_cast<int>(std::lround(cell.y()));
    if (column < 0 || column >= columns_ || row < 0 || row >= rows_) return false;
    const double near_m = distances_m_[static_cast<std::size_t>(row) * columns_ + column];
    if (std::abs(near_m - keep_m_) > kUnit_m) return near_m > keep_m_;
    return distance_m(place) >= keep_m_;
  }

 private:
  double distance_m(const Vector2& place) const {
    const Vector2 inside = (place - scene_.low).cwiseMin(scene_.high - place);
    double least = inside.minCoeff();  // nothing is known beyond
    for (const Obstacle& obstacle : scene_.obstacles) {
      const auto to = [&](const auto& shape) { return gap(place, shape).distance_m; };
      least = std::min(least, std::visit(to, obstacle));
    }
    return least;
  }

  const ReplanScene& scene_;
  double keep_m_;
  int columns_;
  int rows_;
  std::vector<double> distances_m_;
};

class Search {
 public:
  Search(const ReplanScene& scene, const SolverOptions& options)
      : scene_(scene),
        options_(options),
        walls_(scene, ReplanScene::kRobotRadius_m + options.to_walls_m),
        last_step_(std::min(255, static_cast<int>(options.longest_s / kStep_s))) {
    for (int i = 0; i <= last_step_ * kChecks; ++i) {
      for (const SceneMover& mover : scene.movers) {
        const double keep_m = mover.radius_m + ReplanScene::kRobotRadius_m + options.to_movers_m;
        movers_.push_back({truth(mover, i * kStep_s / kChecks).centre, keep_m * keep_m});
      }
    }
  }

  std::optional<double> arrival_time_s() {
    add({0, 0, static_cast<int>(std::lround(scene_.start_speed / kUnitSpeed)), 0, 0});
    for (int count = 0; !open_.empty() && count < kMostExpansions; ++count) {
      const State state = open_.top().state;
      open_.pop();
      if (arrived(state)) return state.step * kStep_s;
      for (int ax = -1; ax <= 1; ++ax) {
        for (int ay = -1; ay <= 1; ++ay) expand(state, ax, ay);
      }
    }
    return std::nullopt;
  }

 private:
  struct Entry {
    double bound_s;
    State state;
    bool operator<(const Entry& other) const {  // the queue's top is the greatest
      if (bound_s != other.bound_s) return bound_s > other.bound_s;
      return state.step < other.state.step;
    }
  };
  struct Kept {
    Vector2 centre;
    double keep_m2;
  };

  bool arrived(const State& state) const {
    return state.vx == 0 && state.vy == 0 &&
           (state.place() - scene_.goal).norm() <= options_.goal_tolerance_m;
  }

  /// Least time to stand at the goal, if nothing were in the way and the speed pointed there.
  double to_go_s(const State& state) const {
    const double far_m =
        std::max(0.0, (state.place() - scene_.goal).norm() - options_.goal_tolerance_m);
    const double push = std::sqrt(2.0) * kPush;
    const double speed = state.velocity().norm();
    const double brake_m = 0.5 * speed * speed / push;
    if (far_m <= brake_m) return speed / push;
    const double top = std::min(options_.max_speed, std::sqrt(push * far_m + 0.5 * speed * speed));
    const double ramps_m = (top * top - 0.5 * speed * speed) / push;
    return (2.0 * top - speed) / push + std::max(0.0, far_m - ramps_m) / top;
  }

  std::uint64_t key(const State& state) const {
    const bool arriving = (state.place() - scene_.goal).norm() < kArriving_m;
    return state.key(arriving ? 1 : kMergeUnits);
  }

  void add(const State& state) {
    const double bound_s = state.step * kStep_s + to_go_s(state);
    if (bound_s > options_.longest_s || state.step > last_step_) return;
    if (seen_.insert(key(state)).second) open_.push({bound_s, state});
  }

  void expand(const State& state, int ax, int ay) {
    if (state.step == 0 && (ax != 0 || ay != 0))
      return;  // a robot that promises first reacts no sooner
    if (kPush * std::hypot(ax, ay) > options_.max_acceleration) return;
    const State next = state.pushed(ax, ay);
    if (next.velocity().norm() > options_.max_speed + 1e-9 || next.step > last_step_) return;
    if (seen_.count(key(next)) > 0 || !turns(state, next) || !clear(state, ax, ay)) return;
    add(next);
  }

  /// Whether the direction of travel changes slowly enough. A robot that stands has to turn first,
  /// so that his front or his back points where he goes; a turn from rest to rest takes 15/8 of
  /// what it would at the highest rate.
  bool turns(const State& from, const State& to) const {
    const Vector2 a = from.velocity();
    const Vector2 b = to.velocity();
    if (b.isZero()) return true;
    if (from.stands()) {
      const int apart = (State::eighths(to.vx, to.vy) - from.heading + 8) % 4;
      const double turn_s =
          1.875 * 0.25 * M_PI * std::min(apart, 4 - apart) / options_.max_yaw_rate;
      return from.rest >= std::lround(turn_s / kStep_s);
    }
    const double cross = a.x() * b.y() - a.y() * b.x();
    return std::abs(std::atan2(cross, a.dot(b))) <= options_.max_yaw_rate * kStep_s;
  }

  bool clear(const State& from, int ax, int ay) const {
    for (int i = 1; i <= kChecks; ++i) {
      const double t = i * kStep_s / kChecks;
      const Vector2 place =
          from.place() + t * from.velocity() + 0.5 * t * t * kPush * Vector2(ax, ay);
      const std::size_t first = (from.step * kChecks + i) * scene_.movers.size();
      for (std::size_t k = first; k < first + scene_.movers.size(); ++k) {
        if ((place - movers_[k].centre).squaredNorm() < movers_[k].keep_m2) return false;
      }
      if (!walls_.clear(place)) return false;
    }
    return true;
  }

  const ReplanScene& scene_;
  const SolverOptions options_;
  const Walls walls_;
  const int last_step_;
  std::vector<Kept> movers_;  // all of them at each check, one check after the other
  std::priority_queue<Entry> open_;
  std::unordered_set<std::uint64_t> seen_;
};

}  // namespace

std::optional<double> arrival_time_s(const ReplanScene& scene, const SolverOptions& options) {
  return Search(scene, options).arrival_time_s();
}

}  // namespace mocha
