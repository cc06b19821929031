#include "planning/maneuvers/escape_search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <queue>
#include <unordered_set>
#include <utility>

#include "planning/candidates/exposure.h"
#include "planning/maneuvers/rolling.h"
#include "trajectory/stopping.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

constexpr double kStep_s = 0.05;
constexpr int kStepsPerEdge = 6;
constexpr int kEdges = 8;  // the way is 2.4 s long, and then brakes
constexpr int kMostExpansions = 1500;
constexpr double kYawRates[] = {-1.0, -0.5, 0.0, 0.5, 1.0};  // shares of the highest
constexpr double kAccelerations[] = {1.0, 0.0, -1.0};        // the same
constexpr int kHeadings = 12;                                // from rest
constexpr double kRest_mps = 0.05;
constexpr double kBehind_mps = 0.01;
constexpr double kHaste = 0.5;  // what lasts longer is looked at sooner, and some way found
// States as near to each other as this are one.
constexpr double kSame_m = 0.15;
constexpr double kSame_rad = 0.26;
constexpr double kSame_mps = 0.4;

/// What is kept from what moves.
struct Keeping {
  double share;   ///< of the clearance
  double growth;  ///< [m/s] more and more of it, for a second
};
constexpr Keeping kKeepings[] = {{1.0, 0.2}, {0.5, 0.06}, {0.0, 0.0}};
constexpr double kGrowth_s = 1.0;

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
  Search(const ManeuverStart& start, const std::vector<MovingThing>& things,
         const MotionLimits& limits)
      : start_(start),
        things_(things),
        limits_(limits),
        join_s_(start.emergency_s),
        state_(start.committed.at(join_s_)),
        target_(start.committed.end_pose().position),
        clear_m_(start.robot.footprint.circumscribed_radius_m() +
                 MarginBudget::of(start.robot).static_margin_m()) {}

  std::optional<Motion> way(const Keeping& keeping) {
    keeping_ = keeping;
    nodes_.clear();
    open_ = {};
    seen_.clear();
    begin();
    for (int count = 0; !open_.empty() && count < kMostExpansions; ++count) {
      const int index = open_.top().node;
      open_.pop();
      const Node node = nodes_[index];
      if (node.step >= first_step(index) + kEdges * kStepsPerEdge) {
        if (auto motion = motion_to(index)) return motion;
        continue;
      }
      for (const double yaw_rate : kYawRates) {
        for (const double acceleration : kAccelerations) expand(index, yaw_rate, acceleration);
      }
    }
    return std::nullopt;
  }

 private:
  /// Under way there is one course, from rest there are many: first it turns in place.
  void begin() {
    if (!state_.at_rest) {
      add({Rolling::from(state_), 0, -1, 0.0, 0.0});
      return;
    }
    for (int i = 0; i < kHeadings; ++i) {
      Rolling rolling = Rolling::from(state_);
      const double change = wrap_angle(2.0 * M_PI * i / kHeadings);
      rolling.course_rad += change;
      const int steps = static_cast<int>(std::ceil(turn_s(change) / kStep_s));
      bool clear = true;
      for (int step = 1; step <= steps && clear; ++step) clear = is_clear(rolling.position, step);
      if (clear) add({rolling, steps, -1, 0.0, 0.0});
    }
  }

  double turn_s(double change_rad) const {
    return std::abs(change_rad) < 1e-6
               ? 0.0
               : turn_duration_s(change_rad, limits_.max_yaw_rate, limits_.max_yaw_acceleration);
  }

  int root(int index) const {
    while (nodes_[index].from >= 0) index = nodes_[index].from;
    return index;
  }
  int first_step(int index) const { return nodes_[root(index)].step; }

  bool is_clear(const Vector2& place, int step) const {
    const double ahead_s = step * kStep_s;
    const double t = join_s_ + ahead_s;
    for (const MovingThing& thing : things_) {
      if (t > thing.until_s) continue;
      const MovingObstacle::Disc disc = thing.obstacle->at(t);
      const double keep_m = thing.keep_m + disc.radius_m -
                            (1.0 - keeping_.share) * start_.robot.moving_clearance_m +
                            keeping_.growth * std::min(ahead_s, kGrowth_s);
      if ((place - disc.centre).squaredNorm() < keep_m * keep_m) return false;
    }
    return start_.scene.obstacles->distance_bound(place) >= clear_m_;
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
    const double to_go_s = (rolling.position - target_).norm() / limits_.max_speed;
    open_.push({to_go_s - kHaste * node.step * kStep_s, static_cast<int>(nodes_.size()) - 1});
  }

  void expand(int index, double yaw_rate, double acceleration) {
    Node next = nodes_[index];
    if (next.rolling.speed < kRest_mps && next.from >= 0 && (acceleration > 0.0 || yaw_rate != 0.0))
      return;  // the end of the way: it stands
    next.from = index;
    next.yaw_rate = yaw_rate * limits_.max_yaw_rate;
    next.acceleration = acceleration * limits_.max_acceleration;
    for (int i = 0; i < kStepsPerEdge; ++i) {
      next.rolling.step(kStep_s, next.yaw_rate, next.acceleration, limits_);
      if (!is_clear(next.rolling.position, ++next.step)) return;
    }
    add(next);
  }

  /// The way to the node and then braking to rest; nothing where that meets something.
  std::optional<Motion> motion_to(int index) const {
    std::vector<int> edges;
    for (int i = index; nodes_[i].from >= 0; i = nodes_[i].from) edges.push_back(i);
    const Node& first = nodes_[root(index)];
    Rolling rolling = first.rolling;
    int step = first.step;
    std::vector<Vector2> places = {rolling.position};
    const auto roll = [&](double yaw_rate, double acceleration) {
      rolling.step(kStep_s, yaw_rate, acceleration, limits_);
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
    if (places.size() < 4) return std::nullopt;
    return assembled(first, places, rolling.course_rad);
  }

  std::optional<Motion> assembled(const Node& first, const std::vector<Vector2>& places,
                                  double final_course_rad) const {
    std::vector<Phase> phases;
    MotionState from = state_;
    const double change = wrap_angle(first.rolling.course_rad - state_.pose.yaw_rad);
    if (state_.at_rest && std::abs(change) > 1e-6) {
      phases.emplace_back(TurnPhase{state_.pose, change, first.step * kStep_s});
      from.pose.yaw_rad = wrap_angle(state_.pose.yaw_rad + change);
    }
    phases.emplace_back(drive_through(from, places, kStep_s, final_course_rad, limits_));
    auto motion = Motion::make(join_s_, std::move(phases));
    if (!motion) return std::nullopt;
    return std::move(motion.motion);
  }

  const ManeuverStart& start_;
  const std::vector<MovingThing>& things_;
  const MotionLimits limits_;
  const double join_s_;
  const MotionState state_;
  const Vector2 target_;
  const double clear_m_;
  Keeping keeping_ = kKeepings[0];
  std::vector<Node> nodes_;
  std::priority_queue<Entry> open_;
  std::unordered_set<std::uint64_t> seen_;
};

}  // namespace

Maneuvers escape_searches(const ManeuverStart& start) {
  const double join_s = start.emergency_s;
  if (!is_alone(start) || start.committed.at(join_s).speed < 0.0) return {};
  MotionLimits limits = start.robot.limits;
  limits.max_acceleration = start.robot.hard_braking().deceleration();
  const std::vector<MovingThing> things = exposed_to(start, join_s);
  Search search(start, things, limits);
  for (const Keeping& keeping : kKeepings) {
    if (auto motion = search.way(keeping))
      return {
          whole(std::move(*motion), join_s, true, "finds a way out, which keeps the most room")};
  }
  return {};
}

}  // namespace mocha
