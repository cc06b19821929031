#include "topology/paths/euclidean_shortcutting.h"

#include <algorithm>
#include <utility>

#include "trajectory/polyline.h"

namespace mocha {
namespace {

constexpr int kParts = 24;                   // from whose ends corners are cut, about
constexpr int kStraightRounds = 3;           // to and fro, at most
constexpr double kWorthAnotherRound = 0.01;  // another round is, after one that gained this share

template <int D>
using Path = std::vector<Eigen::Matrix<double, D, 1>>;

/// The same path with more points on it.
template <int D>
Path<D> refined(const Path<D>& path) {
  const double spacing_m = length_of<D>(path) / kParts;
  Path<D> points = {path.front()};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Matrix<double, D, 1> step = path[i] - path[i - 1];
    const int parts = spacing_m > 0.0 ? 1 + static_cast<int>(step.norm() / spacing_m) : 1;
    for (int k = 1; k < parts; ++k) points.push_back(path[i - 1] + step * k / parts);
    points.push_back(path[i]);
  }
  return points;
}

/// Cuts corners from the front of a path to its back, whichever of the two is earlier.
template <int D>
class EuclideanCutter {
 public:
  using Point = Eigen::Matrix<double, D, 1>;

  EuclideanCutter(const Path<D>& points, const SampledSpace<D>& space)
      : points_(points), space_(space), keys_(points.size(), 0) {
    for (std::size_t i = 1; i < points.size(); ++i)
      keys_[i] = keys_[i - 1] + key(points[i - 1], points[i]);
  }

  Path<D> run() const {
    Path<D> shorter = {points_.front()};
    SignatureKey here = 0;
    for (std::size_t next = 1; next < points_.size();) {
      const std::size_t farthest = farthest_from(shorter.back(), here, next);
      // On from the middle, which is closer to what the path bends around than the end is.
      const Point middle = 0.5 * (shorter.back() + points_[farthest]);
      const bool halve = farthest > next && farthest + 1 < points_.size() &&
                         clear(shorter.back(), middle) && clear(middle, points_[farthest]);
      here = halve ? here + key(shorter.back(), middle) : keys_[farthest];
      shorter.push_back(halve ? middle : points_[farthest]);
      next = halve ? farthest : farthest + 1;
    }
    return shorter;
  }

 private:
  bool clear(const Point& p, const Point& q) const {
    if (space_.in_order(p, q)) return space_.clearance_m(p, q).has_value();
    return space_.in_order(q, p) && space_.clearance_m(q, p).has_value();
  }

  SignatureKey key(const Point& p, const Point& q) const {
    return space_.in_order(p, q) ? space_.key(p, q) : SignatureKey(0) - space_.key(q, p);
  }

  /// One of the last points that the straight line leads to; the one given can be reached. Strides
  /// double while they succeed and halve when they fail.
  std::size_t farthest_from(const Point& p, SignatureKey here, std::size_t reachable) const {
    std::size_t farthest = reachable;
    std::size_t stride = 1;
    for (bool growing = true; stride > 0;) {
      const std::size_t next = farthest + stride;
      const bool reached = next < points_.size() && here + key(p, points_[next]) == keys_[next] &&
                           clear(p, points_[next]);
      if (reached) farthest = next;
      growing = growing && reached;
      stride = growing ? 2 * stride : stride / 2;
    }
    return farthest;
  }

  const Path<D>& points_;
  const SampledSpace<D>& space_;
  std::vector<SignatureKey> keys_;  // from the front to each of the points
};

template <int D>
bool is_clear(const Path<D>& path, const SampledSpace<D>& space) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (!space.in_order(path[i - 1], path[i]) || !space.clearance_m(path[i - 1], path[i]))
      return false;
  }
  return true;
}

}  // namespace

template <int D>
Path<D> with_shortcuts(Path<D> path, const SampledSpace<D>& space) {
  if (path.size() <= 2) return path;
  for (int round = 0; round < kStraightRounds; ++round) {
    Path<D> shorter = path;
    // Backwards as well, as what is cut first bends what is cut later.
    for (int direction = 0; direction < 2; ++direction) {
      shorter = EuclideanCutter<D>(refined<D>(shorter), space).run();
      std::reverse(shorter.begin(), shorter.end());
    }
    // Where it just about fits, a part of a path may fail though the whole has passed.
    if (!is_clear<D>(shorter, space)) return path;
    const double length_m = length_of<D>(path);
    const double gained_m = length_m - length_of<D>(shorter);
    if (gained_m > 0.0 || shorter.size() < path.size()) path = std::move(shorter);
    if (gained_m <= kWorthAnotherRound * length_m) break;
  }
  return path;
}

template std::vector<Eigen::Vector3d> with_shortcuts(std::vector<Eigen::Vector3d>,
                                                     const SampledSpace<3>&);
template std::vector<Eigen::Vector4d> with_shortcuts(std::vector<Eigen::Vector4d>,
                                                     const SampledSpace<4>&);

}  // namespace mocha
