#include "topology/roadmaps/skeleton_tile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "topology/roadmaps/thinning.h"

namespace mocha {
namespace {

constexpr float kBarred = -1.0f;
constexpr int kNone = -1;
constexpr int kApart = 6;                       // cells between gates of one stretch, at least
constexpr std::size_t kStraightNeighbours = 6;  // of a node, that straight edges are tried to

/// One line of the skeleton, as it is followed.
struct Line {
  std::vector<Vector2> between;
  double cost_m = 0.0;
};

}  // namespace

class SkeletonTiler::Builder {
 public:
  Builder(const DistanceField& field, const TravelCost& cost) : field_(field), cost_(cost) {}

  SkeletonTile run(const CornerWindow& window, const std::vector<int>& anchors) {
    look_at(window);
    add_gates();
    for (const int anchor : anchors) {
      const int place = place_of(anchor);
      if (figure_.room[place] >= 0.0f) nodes_.push_back(place);
    }
    std::sort(nodes_.begin(), nodes_.end());
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
    index_.assign(figure_.room.size(), kNone);
    for (std::size_t i = 0; i < nodes_.size(); ++i) index_[nodes_[i]] = static_cast<int>(i);
    if (!is_open_ && !nodes_.empty()) trace(thinning_.run(figure_, nodes_));
    add_straight_edges(is_open_ ? nodes_.size() : kStraightNeighbours);
    for (const int node : nodes_) tile_.nodes.push_back(number_of(node));
    return std::exchange(tile_, {});
  }

 private:
  void look_at(const CornerWindow& window) {
    window_ = window;
    const int columns = window.columns();
    figure_.columns = columns;
    figure_.rows = window.rows();
    around_ = {1, columns + 1, columns, columns - 1, -1, -columns - 1, -columns, -columns + 1};
    nodes_.clear();
    figure_.room.resize(static_cast<std::size_t>(columns) * figure_.rows);
    is_open_ = true;
    float* place = figure_.room.data();
    for (int y = window.y0; y <= window.y1; ++y) {
      for (int x = window.x0; x <= window.x1; ++x, ++place) {
        *place = room(x, y);
        is_open_ = is_open_ && *place >= 0.0f;
      }
    }
  }

  /// Of a corner of the field: its distance to what bars the way.
  float room(int x, int y) const {
    const double distance_m = field_.at_corner(x, y);
    if (distance_m >= cost_.options().required_clearance_m && cost_.blocked().empty())
      return static_cast<float>(distance_m);
    const Vector2 place = field_.corner(x, y);
    if (cost_.at(place, distance_m) == TravelCost::kInfinity) return kBarred;
    return static_cast<float>(std::max(
        0.0,
        std::min(distance_m, cost_.blocked_room_m(place) + cost_.options().required_clearance_m)));
  }

  int place_of(int number) const {
    return (number / field_.columns() - window_.y0) * figure_.columns +
           (number % field_.columns() - window_.x0);
  }
  int x_of(int place) const { return window_.x0 + place % figure_.columns; }
  int y_of(int place) const { return window_.y0 + place / figure_.columns; }
  int number_of(int place) const { return y_of(place) * field_.columns() + x_of(place); }
  Vector2 position(int place) const { return field_.corner(x_of(place), y_of(place)); }
  double distance_m(int place) const { return field_.at_corner(x_of(place), y_of(place)); }
  double cost_at(int place) const { return cost_.at(position(place), distance_m(place)); }

  void add_gates() {
    const int last_row = (figure_.rows - 1) * figure_.columns;
    add_gates(0, 1, figure_.columns);
    add_gates(last_row, 1, figure_.columns);
    add_gates(0, figure_.columns, figure_.rows);
    add_gates(figure_.columns - 1, figure_.columns, figure_.rows);
  }

  /// On one side of the window, from a place in steps. Where a stretch is wide, good ways run at
  /// its middle or by one of its ends, as close to what is there as one would wish.
  void add_gates(int from, int step, int count) {
    for (int begin = 0; begin < count;) {
      int end = begin;
      while (end < count && figure_.room[from + end * step] >= 0.0f) ++end;
      if (end > begin) {
        const auto is_roomy = [&](int k) {
          return distance_m(from + k * step) >= cost_.options().preferred_clearance_m;
        };
        const int middle = widest(from, step, begin, end);
        nodes_.push_back(from + middle * step);
        int first = begin;
        while (first < middle && !is_roomy(first)) ++first;
        int last = end - 1;
        while (last > middle && !is_roomy(last)) --last;
        if (middle - first >= kApart) nodes_.push_back(from + first * step);
        if (last - middle >= kApart) nodes_.push_back(from + last * step);
      }
      begin = end + 1;
    }
  }

  /// Of a stretch, where the map has most room up to what could be wished for, closest to the
  /// middle. Discs do not count: the neighbour may know nothing of them.
  int widest(int from, int step, int begin, int end) const {
    const double plenty_m = cost_.options().preferred_clearance_m;
    const int doubled_middle = begin + end - 1;
    const auto worth = [&](int k) {
      return std::pair(std::min(plenty_m, distance_m(from + k * step)),
                       -std::abs(2 * k - doubled_middle));
    };
    int best = begin;
    for (int k = begin + 1; k < end; ++k) {
      if (worth(k) > worth(best)) best = k;
    }
    return best;
  }

  template <typename Visit>
  void visit_neighbours(int place, const Visit& visit) const {
    const int x = place % figure_.columns;
    const int y = place / figure_.columns;
    for (int k = 0; k < 8; ++k) {
      const int dx = k == 0 || k == 1 || k == 7 ? 1 : k >= 3 && k <= 5 ? -1 : 0;
      const int dy = k >= 1 && k <= 3 ? 1 : k >= 5 ? -1 : 0;
      if (x + dx < 0 || y + dy < 0 || x + dx >= figure_.columns || y + dy >= figure_.rows) continue;
      visit(place + around_[k]);
    }
  }

  bool is_node(int place) const { return index_[place] != kNone; }

  /// Nodes are also the places where the skeleton branches.
  void trace(std::vector<std::uint8_t> skeleton) {
    for (std::size_t place = 0; place < skeleton.size(); ++place) {
      if (!skeleton[place] || is_node(static_cast<int>(place))) continue;
      int neighbours = 0;
      visit_neighbours(static_cast<int>(place), [&](int next) { neighbours += skeleton[next]; });
      if (neighbours <= 2) continue;
      index_[place] = static_cast<int>(nodes_.size());
      nodes_.push_back(static_cast<int>(place));
    }
    for (const int node : nodes_) {
      visit_neighbours(node, [&](int next) {
        if (skeleton[next] && (!is_node(next) || node < next)) follow(node, next, skeleton);
      });
    }
  }

  /// From a node to the next one; what is between has been there then.
  void follow(int node, int next, std::vector<std::uint8_t>& skeleton) {
    Line line;
    int last = node;
    for (int before = kNone;;) {
      add_step(last, next, line);
      if (is_node(next)) break;
      skeleton[next] = 0;
      line.between.push_back(position(next));
      before = std::exchange(last, next);
      next = kNone;
      visit_neighbours(last, [&](int other) {
        if (other == before || !(is_node(other) || skeleton[other])) return;
        if (next == kNone || is_node(other)) next = other;
      });
      if (next == kNone) return;
    }
    if (next != node && std::isfinite(line.cost_m))
      tile_.edges.push_back({index_[node], index_[next], std::move(line.between), line.cost_m});
  }

  /// Where a diagonal step comes too close to obstacles between its ends, it goes by way of the
  /// roomier one of the two other corners of the cell.
  void add_step(int from, int to, Line& line) const {
    const int dx = to % figure_.columns - from % figure_.columns;
    const int dy = to / figure_.columns - from / figure_.columns;
    const double step_m = field_.resolution_m();
    if (dx == 0 || dy == 0) {
      line.cost_m += step_m * 0.5 * (cost_at(from) + cost_at(to));
      return;
    }
    const bool roomy = std::min(figure_.room[from], figure_.room[to]) >=
                       cost_.options().required_clearance_m + step_m;
    if (roomy || cost_.of_line(position(from), position(to)) < TravelCost::kInfinity) {
      line.cost_m += M_SQRT2 * step_m * 0.5 * (cost_at(from) + cost_at(to));
      return;
    }
    const int aside = figure_.room[from + dx] > figure_.room[to - dx] ? from + dx : to - dx;
    line.cost_m += step_m * (0.5 * cost_at(from) + cost_at(aside) + 0.5 * cost_at(to));
    line.between.push_back(position(aside));
  }

  /// Between nodes one of which is among the nearest of the other.
  void add_straight_edges(std::size_t neighbours) {
    std::vector<std::pair<int, int>> pairs;
    std::vector<std::pair<double, int>> others;
    for (int node = 0; node < static_cast<int>(nodes_.size()); ++node) {
      others.clear();
      for (int other = 0; other < static_cast<int>(nodes_.size()); ++other) {
        const Vector2 apart = position(nodes_[other]) - position(nodes_[node]);
        if (other != node) others.emplace_back(apart.squaredNorm(), other);
      }
      const std::size_t near = std::min(neighbours, others.size());
      std::partial_sort(others.begin(), others.begin() + near, others.end());
      for (std::size_t k = 0; k < near; ++k) pairs.push_back(std::minmax(node, others[k].second));
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    for (const auto& [node, other] : pairs) {
      const double cost_m = cost_.of_line(position(nodes_[node]), position(nodes_[other]));
      if (std::isfinite(cost_m)) tile_.edges.push_back({node, other, {}, cost_m});
    }
  }

  const DistanceField& field_;
  const TravelCost& cost_;
  CornerWindow window_{};
  RoomRaster figure_{};
  bool is_open_ = true;  // nothing bars any place
  Thinning thinning_;
  std::array<int, 8> around_{};  // a place
  std::vector<int> nodes_;       // places of the figure
  std::vector<int> index_;       // of each place among the nodes, or kNone
  SkeletonTile tile_;
};

SkeletonTiler::SkeletonTiler(const DistanceField& field, const TravelCost& cost)
    : builder_(std::make_unique<Builder>(field, cost)) {}

SkeletonTiler::~SkeletonTiler() = default;

SkeletonTile SkeletonTiler::tile(const CornerWindow& window, const std::vector<int>& anchors) {
  return builder_->run(window, anchors);
}

}  // namespace mocha
