#include "planning/global/tight_place.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <queue>
#include <unordered_set>

namespace mocha {
namespace {

constexpr double kStep_m = 0.08;
constexpr double kGentle = 1.0;  // curvature [1/m]
constexpr double kSharp = 3.0;   // the same; drives follow such arcs only roughly
constexpr double kTurn_rad = 0.0875;
constexpr double kSmallTurn = 0.4;  // of what a body may turn beside a wall
constexpr double kCheck_m = 0.01;   // between the poses at which the body is looked at
// Of what a way may lose, so much and such a share are left: it is not driven exactly.
constexpr double kToSpare_m = 0.002;
constexpr double kShareToSpare = 0.3;

// Places that are no farther apart count as one; headings more finely where the gap is small.
constexpr double kCell_m = 0.04;
constexpr double kHeading_rad = 0.06;
constexpr double kGap_m = 0.02;

// What a way costs, in metres.
constexpr double kTurnCost_m = 0.3;     // a radian
constexpr double kBackwardCost = 1.2;   // a metre
constexpr double kSwitchCost_m = 0.15;  // another kind of stretch
constexpr double kGreed = 1.5;          // how much what is left counts over what is driven
constexpr double kGapCost = 40.0;       // a metre of gap that is still missing

enum class Kind { kForward, kBackward, kTurn };

Kind kind_of(const Stretch& stretch) {
  if (stretch.length_m == 0.0) return Kind::kTurn;
  return stretch.length_m > 0.0 ? Kind::kForward : Kind::kBackward;
}

double cost_m(const Stretch& stretch) {
  return kTurnCost_m * std::abs(stretch.turn_rad) +
         std::max(stretch.length_m, -kBackwardCost * stretch.length_m);
}

class WayOutSearch {
 public:
  /// With curvatures up to `sharpest`.
  WayOutSearch(const TightPlace& tight, int max_expansions, double sharpest)
      : tight_(tight),
        max_expansions_(max_expansions),
        gentlest_(Leaving::kLoss_m / (tight.reach_m * tight.reach_m)),
        small_turn_rad_(kSmallTurn * Leaving::kLoss_m / tight.reach_m) {
    add_drives(0.0);
    for (double curvature = gentlest_; curvature < sharpest; curvature *= 2.0) {
      add_drives(curvature);
      add_drives(-curvature);
    }
    add_drives(sharpest);
    add_drives(-sharpest);
    for (const double sign : {1.0, -1.0}) {
      stretches_.push_back({0.0, sign * kTurn_rad});
      small_turns_.push_back({0.0, sign * small_turn_rad_});
    }
  }

  std::vector<Stretch> run() {
    const double gap_m = tight_.gap_m(tight_.start);
    add({tight_.start, 0.0, 0.0, gap_m, std::min(gap_m, tight_.margin_m), -1, {}});
    for (int looked_at = 0; looked_at < max_expansions_ && !open_.empty(); ++looked_at) {
      const int index = open_.top().node;
      open_.pop();
      const Node node = nodes_[index];
      if (!closed_.insert(key(node)).second) continue;
      if (node.kept_m >= tight_.margin_m && tight_.is_out(node.pose)) return way_to(index);
      for (const Stretch& stretch : stretches_) extend(index, stretch);
      if (!is_tight(node)) continue;
      for (const Stretch& turn : small_turns_) extend(index, turn);
    }
    return {};
  }

 private:
  struct Node {
    Pose pose;
    double cost_m;
    double way_m;   // driven so far
    double gap_m;   // here
    double kept_m;  // the most of the gap so far, up to the margin
    int parent;
    Stretch stretch;  // that leads here
  };

  struct Entry {
    double estimate_m;
    int node;
    bool operator<(const Entry& other) const { return estimate_m > other.estimate_m; }
  };

  void add_drives(double curvature) {
    stretches_.push_back({kStep_m, curvature * kStep_m});
    if (tight_.can_reverse) stretches_.push_back({-kStep_m, curvature * kStep_m});
  }

  /// Whether a stretch goes on with another of its kind. A turn does to the same side: to and fro
  /// could come to nothing, which is no motion. A drive does with at most twice its curvature, to
  /// the same side: from straight on, with the gentlest.
  bool is_smooth(const Stretch& before, const Stretch& after) const {
    if (after.length_m == 0.0) return before.turn_rad * after.turn_rad > 0.0;
    const double change_rad = std::abs(after.turn_rad - before.turn_rad);
    return change_rad <= std::abs(before.turn_rad) + 1.01 * gentlest_ * kStep_m;
  }

  bool is_tight(const Node& node) const { return node.gap_m < tight_.margin_m + Leaving::kLoss_m; }

  std::uint64_t key(const Node& node) const {
    const auto bits = [](double value, double step, int shift) {
      return (static_cast<std::uint64_t>(std::llround(value / step)) & 0xffff) << shift;
    };
    const Vector2 place = node.pose.position - tight_.start.position;
    return bits(place.x(), kCell_m, 0) | bits(place.y(), kCell_m, 16) |
           bits(wrap_angle(node.pose.yaw_rad), is_tight(node) ? small_turn_rad_ : kHeading_rad,
                32) |
           bits(required_m(node.kept_m, node.way_m), kGap_m, 48);
  }

  void add(const Node& node) {
    const double left_m = (node.pose.position - tight_.exit).norm();
    const double lacking_m = std::max(0.0, tight_.margin_m - node.gap_m);
    open_.push(
        {node.cost_m + kGreed * left_m + kGapCost * lacking_m, static_cast<int>(nodes_.size())});
    nodes_.push_back(node);
  }

  void extend(int parent, const Stretch& stretch) {
    Node next = nodes_[parent];
    const bool switches = next.parent >= 0 && kind_of(stretch) != kind_of(next.stretch);
    if (next.parent >= 0 && !switches && !is_smooth(next.stretch, stretch)) return;
    next.cost_m += cost_m(stretch) + (switches ? kSwitchCost_m : 0.0);
    next.way_m += std::abs(stretch.length_m);
    next.stretch = stretch;
    next.parent = parent;
    if (drive(next) && closed_.count(key(next)) == 0) add(next);
  }

  /// Drives the stretch of a node that is still where the stretch begins; false where the body
  /// comes too close.
  bool drive(Node& node) const {
    const Pose from = node.pose;
    const double length_m = std::abs(node.stretch.length_m);
    const double turn_m = tight_.reach_m * std::abs(node.stretch.turn_rad);
    const double sweep_m = length_m + turn_m;
    const int parts = std::max(1, static_cast<int>(std::ceil(sweep_m / kCheck_m)));
    for (int i = 1; i <= parts; ++i) {
      const double share = static_cast<double>(i) / parts;
      node.pose = along(from, node.stretch, share);
      node.gap_m = tight_.gap_m(node.pose);
      const double way_m = node.way_m - (1.0 - share) * length_m;
      if (node.gap_m < tight_.margin_m && node.gap_m < required_m(node.kept_m, way_m)) return false;
      node.kept_m = std::min(std::max(node.kept_m, node.gap_m), tight_.margin_m);
      // No part can use up that much.
      if (node.gap_m - tight_.margin_m > sweep_m) i = std::max(i, parts - 1);
    }
    return true;
  }

  /// The gap to have after a way on which it was `kept_m` at most.
  double required_m(double kept_m, double way_m) const {
    if (kept_m >= tight_.margin_m || way_m >= tight_.leaving.way_m) return tight_.margin_m;
    const double least_m = tight_.leaving.required_m(kept_m - Leaving::kSlack_m, tight_.margin_m);
    return least_m + std::min(kToSpare_m, kShareToSpare * (kept_m - least_m));
  }

  std::vector<Stretch> way_to(int node) const {
    std::vector<Stretch> way;
    for (; nodes_[node].parent >= 0; node = nodes_[node].parent)
      way.push_back(nodes_[node].stretch);
    std::reverse(way.begin(), way.end());
    return way;
  }

  const TightPlace& tight_;
  const int max_expansions_;
  // Curvature of the arcs beside a wall, where a corner swings by half of what may be lost [1/m].
  // The heading that it leaves soon allows for more.
  const double gentlest_;
  const double small_turn_rad_;
  std::vector<Stretch> stretches_;
  std::vector<Stretch> small_turns_;
  std::vector<Node> nodes_;
  std::priority_queue<Entry> open_;
  std::unordered_set<std::uint64_t> closed_;
};

}  // namespace

Pose along(const Pose& pose, const Stretch& stretch, double share) {
  const double turn_rad = share * stretch.turn_rad;
  const double length_m = share * stretch.length_m;
  const double half_rad = 0.5 * turn_rad;
  const bool straight = std::abs(half_rad) < 1e-6;
  const double chord_m = straight ? length_m : length_m * std::sin(half_rad) / half_rad;
  const double course_rad = pose.yaw_rad + half_rad;
  return {pose.position + chord_m * Vector2(std::cos(course_rad), std::sin(course_rad)),
          pose.yaw_rad + turn_rad};
}

std::vector<Stretch> find_way_out(const TightPlace& tight, int max_expansions) {
  const auto way = WayOutSearch(tight, max_expansions, kGentle).run();
  return way.empty() ? WayOutSearch(tight, max_expansions, kSharp).run() : way;
}

}  // namespace mocha
