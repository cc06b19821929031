#pragma once

#include <array>
#include <vector>

#include "topology/roadmaps/static_space.h"
#include "topology/space_time/space_time_tube.h"

namespace mocha {

/// The axes of a plane.
struct ProjectionPlane {
  int first;
  int second;
};
/// The plane in which windings are counted, for D = 2, and the others, for D = 3.
inline constexpr std::array<ProjectionPlane, 3> kProjectionPlanes = {{{0, 1}, {0, 2}, {1, 2}}};

/// Where and when paths begin and end.
template <int D>
struct SpaceTimeEnds {
  Eigen::Matrix<double, D, 1> start;
  Eigen::Matrix<double, D, 1> goal;
  double start_s;
  double goal_s;
};

/// Space with time as its last axis (paper V-C): a point is (place, max_speed * time since the
/// start), all of it in metres, so that at 45 degrees one moves at max_speed. A straight line is a
/// uniform motion.
///
/// Its length is the Euclidean one: of all paths between two points the uniform one is the
/// shortest, and to stand and then hurry is longer than to be slow all along, though the ground
/// covered is the same. For a path at speeds v it is, for small v, its duration plus the integral
/// of v^2 / 2: what is shortest here is what an optimiser of energy likes.
///
/// Obstacles stand, or move in tubes. A path that starts inside a tube may stay and leave, as
/// check_separation_or_leaving() has it: what lacks in distance at the start (and 3 mm) is
/// forgiven, less and less, by 0.1 max_speed in a second. So it must not come closer in any case,
/// and gains at that rate at least until it has regained the distance; later on it must keep it.
///
/// Classes. Obstacles are the static ones of `cuts` first, then the moving ones in the given order.
/// D = 2: the entry of a moving one is the winding of the relative path p(t) - o(t) about the
/// origin, as Cuts<2> count it; an exact invariant. Where a tube ends before the goal, its thing is
/// no more, and could be passed by either side at will; what counts is the path until then,
/// continued straight to the goal. D = 3: each moving one has three entries, one for each
/// projection (x, y), (x, z), (y, z). They tell paths apart that may well be deformed into each
/// other, led around the ball along the axis that is projected out: in space and time the free
/// space around balls has but one class, and Prop. 1 of the paper proves nothing of them. A tube
/// that cannot be met on any path to the goal in time has entries 0.
template <int D>
class SpaceTime : public SampledSpace<D + 1> {
 public:
  using typename SampledSpace<D + 1>::Point;
  using Place = Eigen::Matrix<double, D, 1>;
  using Box = Eigen::AlignedBox<double, D>;

  /// `field` and `cuts` must live longer. Throws std::invalid_argument unless the ends are finite,
  /// the goal is later than the start, and max_speed [m/s] is above 0 and finite; for options as
  /// StaticSpace does.
  SpaceTime(const ObstacleField<D>& field, const Cuts<D>& cuts, const Box& bounds,
            const SpaceTimeEnds<D>& ends, double max_speed, std::vector<Tube<D>> tubes,
            const ClearanceOptions& options);

  Point start() const { return point(ends_.start, ends_.start_s); }
  Point goal() const { return point(ends_.goal, ends_.goal_s); }
  Point point(const Place& place, double time_s) const;
  double time_s(const Point& p) const { return ends_.start_s + since_start_s(p); }

  /// Spread over what can be reached from the start and from where the goal can be reached: evenly
  /// in time; denser at the ends, where that is narrow.
  Point at(const Point& shares) const override;

  /// Whether q is later than p and one gets there at max_speed. By at least 1e-6 m later, as less
  /// is no motion that a division stands; faster than max_speed by a share of up to 1e-9, as a
  /// straight line at full speed is to remain possible when its ends are rounded.
  bool in_order(const Point& p, const Point& q) const override;

  /// Static obstacles as in StaticSpace, tubes exactly; nothing outside of the bounds.
  std::optional<double> clearance_m(const Point& p) const override { return clearance_m(p, p); }
  std::optional<double> clearance_m(const Point& p, const Point& q) const override;

  SignatureKey key(const Point& p, const Point& q) const override;
  /// Of a path in order, with straight lines between its points.
  Signature signature_of(const std::vector<Point>& path) const;

  double since_start_s(const Point& p) const { return p[D] / max_speed_; }

 private:
  struct Moving {
    int entry;     ///< in signatures, its first one
    Tube<D> tube;  ///< in time since the start, as one has to keep away from it
  };
  double duration_s() const { return ends_.goal_s - ends_.start_s; }
  Tube<D> forgiven(const Tube<D>& tube) const;
  bool reachable(const TubePiece<D>& piece) const;
  template <typename Visit>
  void cross(const Point& p, const Point& q, const Visit& visit) const;
  template <typename Visit>
  void cross(const Moving& moving, const Point& p, const Point& q, const Visit& visit) const;

  const SpaceTimeEnds<D> ends_;
  const double max_speed_;
  const Box bounds_;
  const StaticSpace<D> still_;
  const Cuts<D>& cuts_;
  int entries_;
  std::vector<Moving> moving_;         // what can be met
  std::vector<TubePiece<D>> threats_;  // their pieces that can be met, in time since the start
};

extern template class SpaceTime<2>;
extern template class SpaceTime<3>;

}  // namespace mocha
