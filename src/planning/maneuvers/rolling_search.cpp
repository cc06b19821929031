#include "planning/maneuvers/rolling_search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <queue>
#include <unordered_set>
#include <utility>

#include "planning/candidates/exposure.h"
#include "planning/maneuvers/rolling.h"
#include "trajectory/stopping.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

constexpr double kSearchStep_s = 0.05;
constexpr int kStepsPerEdge = 6;
constexpr int kMostExpansions = 3000;
constexpr std::size_t kMostWays = 6;  // that a curve may turn out to break the limits along
constexpr double kTriedYawRates[] = {-1.0, -0.5, 0.0, 0.5, 1.0};  // shares of the highest
constexpr double kTriedAccelerations[] = {1.0, 0.0, -1.0};        // the same
constexpr int kHeadings = 12;                                     // from rest
constexpr double kSlowestOnward_mps = 0.05;
constexpr double kBehind_mps = 0.01;
constexpr double kPast = 0.4;      // weight of the time so far, against the time to go
constexpr double kGrowth_s = 1.0;  // for which what is kept grows
constexpr double kNearer_m = 0.01;
constexpr double kReaction_m = 2.0;  // beyond what the robot can reach, nothing is looked at
// States as near to each other as this are one.
constexpr double kSame_m = 0.15;
constexpr double kSame_rad = 0.26;
constexpr double kSame_mps = 0.4;

/// A disc to keep from at one step.
struct Disc {
  Vector2 centre;
  double keep_m;  ///< of the robot's centre from the disc's, with all of the clearance
  double most_m;  ///< that can be kept
};

/// What moves, step by step.
class MovingDiscs {
 public:
  MovingDiscs(const ManeuverStart& start, const Vector2& from, const RollingSearchOptions& options)
      : steps_(1 + static_cast<int>((options.duration_s + options.stands_s + kLongest_s) /
                                    kSearchStep_s)),
        clearance_m_(start.robot.moving_clearance_m) {
    for (const MovingThing& thing : exposed_to(start, options.join_s)) {
      const double here_m = room_m(thing, from, options.join_s);
      const double most_m = here_m < 0.0 ? here_m + keep_m(thing, options.join_s) - kNearer_m
                                         : std::numeric_limits<double>::infinity();
      for (int step = 0; step < static_cast<int>(steps_.size()); ++step) {
        const double ahead_s = step * kSearchStep_s;
        const double t = options.join_s + ahead_s;
        if (t > thing.until_s) break;
        if (room_m(thing, from, t) > ahead_s * options.limits.max_speed + kReaction_m) continue;
        steps_[step].push_back({thing.obstacle->at(t).centre, keep_m(thing, t), most_m});
      }
    }
  }

  bool is_clear(const Vector2& place, int step, const Keeping& keeping) const {
    if (step >= static_cast<int>(steps_.size())) return true;
    const double more_m = keeping.growth * std::min(step * kSearchStep_s, kGrowth_s) -
                          (1.0 - keeping.share) * clearance_m_;
    return std::none_of(steps_[step].begin(), steps_[step].end(), [&](const Disc& disc) {
      const double kept_m = std::min(disc.most_m, disc.keep_m + more_m);
      return (place - disc.centre).squaredNorm() < kept_m * kept_m;
    });
  }

 private:
  static constexpr double kLongest_s = 3.0;  // to turn before a way, and to brake after it

  static double keep_m(const MovingThing& thing, double t) {
    return thing.keep_m + thing.obstacle->at(t).radius_m;
  }
  static double room_m(const MovingThing& thing, const Vector2& place, double t) {
    return (thing.obstacle->at(t).centre - place).norm() - keep_m(thing, t);
  }

  std::vector<std::vector<Disc>> steps_;
  const double clearance_m_;
};

/// Returns how the turn in place that is under way at `join_s` is ended; nothing where none is.
std::optional<TurnPhase> stop_of_turn(const ManeuverStart& start, double join_s) {
  const Phase stop = brake_along(start.committed, join_s, start.robot.braking()).front();
  const auto* turn = std::get_if<TurnPhase>(&stop);
  return turn != nullptr ? std::make_optional(*turn) : std::nullopt;
}

struct Node {
  Rolling rolling;
  int step;  // from the start
  int from;
  double yaw_rate;
  double acceleration;
};

struct Entry {
  double cost_s;  // least first
  int node;
  bool operator<(const Entry& other) const { return cost_s > other.cost_s; }
};

class Search {
 public:
  Search(const ManeuverStart& start, const RollingSearchOptions& options)
      : start_(start),
        limits_(options.limits),
        join_s_(options.join_s),
        stop_(stop_of_turn(start, join_s_)),
        state_(stop_ ? Motion(join_s_, {*stop_}).at(join_s_ + stop_->duration_s)
                     : start.committed.at(join_s_)),
        steps_(kStepsPerEdge *
               static_cast<int>(std::lround(options.duration_s / (kStepsPerEdge * kSearchStep_s)))),
        stands_s_(options.stands_s),
        clear_m_(start.robot.footprint.circumscribed_radius_m() +
                 MarginBudget::of(start.robot).static_margin_m()),
        discs_(start, state_.pose.position, options) {}

  std::vector<Motion> ways(const Keeping& keeping) {
    keeping_ = keeping;
    nodes_.clear();
    open_ = {};
    seen_.clear();
    begin();
    std::vector<Motion> ways;
    for (int count = 0; !open_.empty() && count < kMostExpansions && ways.size() < kMostWays;
         ++count) {
      const int index = open_.top().node;
      open_.pop();
      if (nodes_[index].step >= root_of(index).step + steps_) {
        if (auto motion = motion_to(index)) ways.push_back(std::move(*motion));
        continue;
      }
      for (const double yaw_rate : kTriedYawRates) {
        for (const double acceleration : kTriedAccelerations) expand(index, yaw_rate, acceleration);
      }
    }
    return ways;
  }

 private:
  /// Under way there is one course, from rest there are many: first it turns in place.
  void begin() {
    if (!state_.at_rest) {
      add({Rolling::from(state_), 0, -1, 0.0, 0.0});
      return;
    }
    const double stop_s = stop_ ? stop_->duration_s : 0.0;
    for (int i = 0; i < kHeadings; ++i) {
      const double change = wrap_angle(2.0 * M_PI * i / kHeadings);
      const int steps = static_cast<int>(std::ceil((stop_s + turn_s(change)) / kSearchStep_s));
      if (stays_clear(state_.pose.position, 1, steps))
        add({Rolling::setting_off(state_.pose, change, limits_), steps, -1, 0.0, 0.0});
    }
  }

  double turn_s(double change_rad) const {
    return std::abs(change_rad) < 1e-6
               ? 0.0
               : turn_duration_s(change_rad, limits_.max_yaw_rate, limits_.max_yaw_acceleration);
  }

  const Node& root_of(int index) const {
    while (nodes_[index].from >= 0) index = nodes_[index].from;
    return nodes_[index];
  }

  bool is_clear(const Vector2& place, int step) const {
    const auto& unseen = start_.scene.unseen;
    return discs_.is_clear(place, step, keeping_) &&
           start_.scene.obstacles->distance_bound(place) >= clear_m_ &&
           (!unseen || unseen->distance_bound(place) >= clear_m_);
  }

  /// From one step to another.
  bool stays_clear(const Vector2& place, int first, int last) const {
    for (int step = first; step <= last; ++step) {
      if (!is_clear(place, step)) return false;
    }
    return true;
  }

  void add(const Node& node) {
    const Rolling& rolling = node.rolling;
    const auto cell = [](double value, double size) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(value / size))) &
             0xfff;
    };
    std::uint64_t key = cell(rolling.position.x() - state_.pose.position.x(), kSame_m);
    key = key << 12 | cell(rolling.position.y() - state_.pose.position.y(), kSame_m);
    key = key << 12 | cell(wrap_angle(rolling.course_rad), kSame_rad);
    key = key << 12 | cell(rolling.speed, kSame_mps);
    key = key << 12 | static_cast<std::uint64_t>(node.step);
    if (!seen_.insert(key).second) return;
    nodes_.push_back(node);
    const double to_go_s = (rolling.position - start_.target).norm() / limits_.max_speed;
    open_.push({to_go_s + kPast * node.step * kSearchStep_s, static_cast<int>(nodes_.size()) - 1});
  }

  void expand(int index, double yaw_rate, double acceleration) {
    Node next = nodes_[index];
    if (next.rolling.speed < kSlowestOnward_mps && next.from >= 0 &&
        (acceleration > 0.0 || yaw_rate != 0.0))
      return;  // the end of the way: it stands
    next.from = index;
    next.yaw_rate = yaw_rate * limits_.max_yaw_rate;
    next.acceleration = acceleration * limits_.max_acceleration;
    for (int i = 0; i < kStepsPerEdge; ++i) {
      next.rolling.step(kSearchStep_s, next.yaw_rate, next.acceleration, limits_);
      if (!is_clear(next.rolling.position, ++next.step)) return;
    }
    add(next);
  }

  /// The way to the node and then braking to rest; nothing where that meets something.
  std::optional<Motion> motion_to(int index) const {
    std::vector<int> edges;
    for (int i = index; nodes_[i].from >= 0; i = nodes_[i].from) edges.push_back(i);
    const Node& first = root_of(index);
    Rolling rolling = first.rolling;
    int step = first.step;
    std::vector<Vector2> places = {rolling.position};
    const auto roll = [&](double yaw_rate, double acceleration) {
      rolling.step(kSearchStep_s, yaw_rate, acceleration, limits_);
      places.push_back(rolling.position);
      ++step;
    };
    for (auto edge = edges.rbegin(); edge != edges.rend(); ++edge) {
      for (int i = 0; i < kStepsPerEdge && (step == first.step || rolling.speed > kBehind_mps); ++i)
        roll(nodes_[*edge].yaw_rate, nodes_[*edge].acceleration);
    }
    while (rolling.speed > kBehind_mps) {
      roll(0.0, -limits_.max_acceleration);
      if (!is_clear(rolling.position, step)) return std::nullopt;
    }
    const int stands = step + static_cast<int>(stands_s_ / kSearchStep_s);
    if (places.size() < 4 || !stays_clear(rolling.position, step, stands)) return std::nullopt;
    return assembled(first, places, rolling.course_rad);
  }

  std::optional<Motion> assembled(const Node& first, const std::vector<Vector2>& places,
                                  double final_course_rad) const {
    std::vector<Phase> phases;
    if (stop_) phases.emplace_back(*stop_);
    MotionState from = state_;
    const double change = wrap_angle(first.rolling.course_rad - state_.pose.yaw_rad);
    const double left_s = first.step * kSearchStep_s - (stop_ ? stop_->duration_s : 0.0);
    if (state_.at_rest && std::abs(change) > 1e-6) {
      phases.emplace_back(TurnPhase{state_.pose, change, left_s});
      from.pose.yaw_rad = wrap_angle(state_.pose.yaw_rad + change);
    } else if (stop_) {
      phases.emplace_back(StandPhase{state_.pose, left_s});
    }
    phases.emplace_back(drive_through(from, places, kSearchStep_s, final_course_rad, limits_));
    auto motion = Motion::make(join_s_, std::move(phases));
    if (!motion) return std::nullopt;
    return std::move(motion.motion);
  }

  const ManeuverStart& start_;
  const MotionLimits limits_;
  const double join_s_;
  const std::optional<TurnPhase> stop_;  // of the turn that is under way
  const MotionState state_;              // after it
  const int steps_;                      // of a way
  const double stands_s_;
  const double clear_m_;
  const MovingDiscs discs_;
  Keeping keeping_{};
  std::vector<Node> nodes_;
  std::priority_queue<Entry> open_;
  std::unordered_set<std::uint64_t> seen_;
};

}  // namespace

std::vector<Motion> rolling_ways(const ManeuverStart& start, const RollingSearchOptions& options) {
  if (start.committed.at(options.join_s).speed < 0.0) return {};
  Search search(start, options);
  for (const Keeping& keeping : options.keepings) {
    auto ways = search.ways(keeping);
    if (!ways.empty()) return ways;
  }
  return {};
}

}  // namespace mocha
