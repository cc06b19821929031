#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <variant>
#include <vector>

namespace mocha {

/// The H-signature, paper (36), of a path: how often it crosses the cut of each obstacle, forward
/// minus backward. Two paths with the same ends that can be deformed into each other have the same
/// signature; their difference is the winding number, paper (35), of the loop that they form about
/// each obstacle, so the integers are exact where paper (35) on open paths has ties.
using Signature = std::vector<int>;

/// A signature as one number, for look-up: signatures add up along a path, and so do their keys.
/// Different signatures share a key with a probability of 2^-64.
using SignatureKey = std::uint64_t;

/// The share of obstacle `r` in a key, for one forward crossing of its cut.
SignatureKey key_of(int obstacle);

/// The cuts of obstacles: what a path must cross to change its class.
template <int D>
class Cuts;

/// In the plane: upright rays from a point of each obstacle's solid matter to infinity (towards
/// +y).
template <>
class Cuts<2> {
 public:
  using Point = Eigen::Vector2d;

  /// `representatives`: for each obstacle a point that no path can meet.
  explicit Cuts(const std::vector<Point>& representatives);

  int obstacles() const { return static_cast<int>(rays_.size()); }

  /// Calls visit(obstacle, sign) for each cut that the straight line from p to q crosses; sign is
  /// +1 for counter-clockwise about the obstacle, else -1.
  template <typename Visit>
  void cross(const Point& p, const Point& q, const Visit& visit) const {
    const auto before = [](double x, const Ray& ray) { return x < ray.foot.x(); };
    const auto first = std::upper_bound(rays_.begin(), rays_.end(), std::min(p.x(), q.x()), before);
    const auto last = std::upper_bound(first, rays_.end(), std::max(p.x(), q.x()), before);
    for (auto ray = first; ray != last; ++ray) {
      if (const int sign = crossing(ray->foot, p, q); sign != 0) visit(ray->obstacle, sign);
    }
  }

  /// The sign with which the straight line from p to q crosses the cut of an obstacle at `foot`; 0
  /// where it does not.
  static int crossing(const Point& foot, const Point& p, const Point& q) {
    const bool leftward = q.x() < p.x();
    // Half-open, so that a corner on a cut counts for one of its two neighbours.
    if (!(leftward ? q.x() < foot.x() && foot.x() <= p.x() : p.x() < foot.x() && foot.x() <= q.x()))
      return 0;
    const Point along = q - p;
    const Point to_foot = foot - p;
    const double turn = along.x() * to_foot.y() - along.y() * to_foot.x();
    if (leftward) return turn > 0.0 ? 1 : 0;
    return turn < 0.0 ? -1 : 0;
  }

 private:
  struct Ray {
    Point foot;
    int obstacle;
  };
  std::vector<Ray> rays_;  // by x
};

/// A vertical line without ends, such as a pillar from floor to ceiling.
struct Column {
  Eigen::Vector2d foot;
};

/// A closed polygon in space, such as the frame of a window.
struct Loop {
  std::vector<Eigen::Vector3d> corners;  ///< the last is joined to the first
};

/// An open polygon in space that goes on straight up from both of its ends, without end: such as
/// what stands between two windows, and goes on through the wall to where nobody can be.
struct Arch {
  std::vector<Eigen::Vector3d> corners;
};

/// The cuts of obstacles in space, each shrunk to a curve inside of its solid matter: half planes
/// that stand on columns (towards +y), and curtains that stand on loops and arches (towards +z).
/// The sum over a closed path is its Gauss linking number with the curve: exact for coordinates up
/// to 500 m if the path keeps more than 0.1 mm off the curve.
template <>
class Cuts<3> {
 public:
  using Point = Eigen::Vector3d;
  using Curve = std::variant<Column, Loop, Arch>;

  /// Throws std::invalid_argument for a loop with fewer than three corners, an arch with fewer than
  /// two.
  explicit Cuts(const std::vector<Curve>& curves);

  int obstacles() const { return obstacles_; }

  /// As in the plane; the sign is that of the Gauss linking number, columns pointing upward.
  template <typename Visit>
  void cross(const Point& p, const Point& q, const Visit& visit) const {
    columns_.cross(p.head<2>(), q.head<2>(),
                   [&](int column, int sign) { visit(column_obstacles_[column], sign); });
    const Point from = snapped(p);
    const Point to = snapped(q);
    const Point low = from.cwiseMin(to);
    const Point high = from.cwiseMax(to);
    const auto first = std::partition_point(
        sides_.begin(), sides_.end(), [&](const Side& side) { return side.reach_x < low.x(); });
    for (auto side = first; side != sides_.end() && side->low.x() <= high.x(); ++side) {
      const bool is_apart = side->high_x < low.x() || side->low.y() > high.y() ||
                            side->high_y < low.y() || side->low.z() > high.z();
      if (is_apart) continue;
      if (const int sign = crossing(*side, from, to); sign != 0) visit(side->obstacle, sign);
    }
  }

 private:
  struct Side {
    Point low;  // of the box about both ends
    double high_x;
    double high_y;
    double reach_x;  // the highest x of this side and of all before it
    Point from;
    Point to;
    int obstacle;
  };
  void add_sides(const std::vector<Point>& corners, std::size_t least, bool is_closed,
                 int obstacle);
  void add_side(const Point& from, const Point& to, int obstacle);
  static Point snapped(const Point& p);
  static int crossing(const Side& side, const Point& p, const Point& q);

  int obstacles_;
  Cuts<2> columns_;
  std::vector<int> column_obstacles_;
  std::vector<Side> sides_;  // by their lowest x
};

/// Of a path with straight lines between its points.
template <int D>
Signature signature_of(const Cuts<D>& cuts, const std::vector<Eigen::Matrix<double, D, 1>>& path) {
  Signature signature(cuts.obstacles(), 0);
  for (std::size_t i = 1; i < path.size(); ++i) {
    cuts.cross(path[i - 1], path[i], [&](int r, int sign) { signature[r] += sign; });
  }
  return signature;
}

/// Of the straight line from p to q.
template <int D>
SignatureKey key_of(const Cuts<D>& cuts, const Eigen::Matrix<double, D, 1>& p,
                    const Eigen::Matrix<double, D, 1>& q) {
  SignatureKey key = 0;
  cuts.cross(p, q, [&](int r, int sign) { key += sign * key_of(r); });
  return key;
}

/// Whether one of the items is of that class.
template <typename Item>
bool has_class(const std::vector<Item>& items, const Signature& signature) {
  return std::any_of(items.begin(), items.end(),
                     [&](const Item& item) { return item.signature == signature; });
}

}  // namespace mocha
