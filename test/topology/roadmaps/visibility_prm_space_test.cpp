#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "topology/roadmaps/roadmap_classes.h"
#include "topology/roadmaps/visibility_prm.h"
#include "topology/shipped_options.h"

namespace mocha {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Bars of round section.
class Bars : public ObstacleField<3> {
 public:
  Bars(std::vector<std::pair<Vector3d, Vector3d>> axes, double radius_m)
      : axes_(std::move(axes)), radius_m_(radius_m) {}

  Sample sample(const Vector3d& p) const override { return {distance_bound(p), Vector3d::UnitX()}; }
  double distance_bound(const Vector3d& p) const override {
    double least_m = 1e9;
    for (const auto& [from, to] : axes_) {
      const Vector3d axis = to - from;
      const double share = std::clamp(axis.dot(p - from) / axis.squaredNorm(), 0.0, 1.0);
      least_m = std::min(least_m, (from + share * axis - p).norm() - radius_m_);
    }
    return std::max(0.0, least_m);
  }
  bool clear(const Box&, double) const override { return false; }

 private:
  std::vector<std::pair<Vector3d, Vector3d>> axes_;
  double radius_m_;
};

TEST(VisibilityPrmInSpace, FindsTheWayThroughAWindowAndRoundPillars) {
  const Loop window{{{10.0, 3.5, 1.0}, {10.0, 6.5, 1.0}, {10.0, 6.5, 4.0}, {10.0, 3.5, 4.0}}};
  const Vector2d pillar(5.0, 5.0);
  std::vector<std::pair<Vector3d, Vector3d>> axes = {{{5.0, 5.0, -99.0}, {5.0, 5.0, 99.0}}};
  for (int i = 0; i < 4; ++i) axes.push_back({window.corners[i], window.corners[(i + 1) % 4]});
  const Bars field(axes, 0.3);
  const Cuts<3> cuts({Column{pillar}, window});
  const AlignedBox3d bounds(Vector3d(0.0, 0.0, 0.0), Vector3d(15.0, 10.0, 6.0));
  const Vector3d start(1.0, 5.0, 2.5);
  const Vector3d goal(14.0, 5.0, 2.5);
  const ClearanceOptions clearance = shipped_clearance();
  const StaticSpace<3> space(field, cuts, bounds, start, clearance);
  const Roadmap<3> roadmap = visibility_prm<3>(space, start, goal, prm_options());
  for (const auto& edge : roadmap.edges) {
    const Vector3d p = roadmap.nodes[edge.from].position;
    const Vector3d q = roadmap.nodes[edge.to].position;
    double least_m = 1e9;
    for (int i = 0; i <= 200; ++i) {
      least_m = std::min(least_m, field.distance_bound(p + (q - p) * (i / 200.0)));
    }
    ASSERT_GE(least_m, clearance.required_m);
    ASSERT_LE(edge.clearance_m, least_m);
  }
  const auto classes = shortest_of_each_class<3>(roadmap, space, 17.0);
  for (const double y : {3.5, 6.5}) {    // on either side of the pillar
    for (const double z : {2.5, 5.0}) {  // through the window and over it
      const std::vector<Vector3d> path = {start, {5.0, y, 2.5}, {10.0, 5.0, z}, goal};
      SignatureKey key = 0;
      for (std::size_t i = 1; i < path.size(); ++i) key += space.key(path[i - 1], path[i]);
      ASSERT_EQ(classes.count(key), 1u) << y << " " << z;
    }
  }
}

/// The plane, with time as a third axis; a disc crosses it.
class CrossedPlane : public SampledSpace<3> {
 public:
  static constexpr double kFastest = 2.0;  // metres of way per unit of time
  static constexpr double kRadius_m = 1.5;

  Vector3d at(const Vector3d& shares) const override { return 10.0 * shares; }
  std::optional<double> clearance_m(const Vector3d& p) const override { return clearance_m(p, p); }
  bool in_order(const Vector3d& p, const Vector3d& q) const override {
    return q.z() > p.z() && length_m(p, q) <= kFastest * (q.z() - p.z());
  }
  std::optional<double> clearance_m(const Vector3d& p, const Vector3d& q) const override {
    const Vector2d from = relative(p);
    const Vector2d along = relative(q) - from;
    const double length2 = along.squaredNorm();
    const double share = length2 > 0.0 ? std::clamp(-along.dot(from) / length2, 0.0, 1.0) : 0.0;
    const double clearance_m = (from + share * along).norm() - kRadius_m;
    return clearance_m > 0.0 ? std::optional(clearance_m) : std::nullopt;
  }
  double length_m(const Vector3d& p, const Vector3d& q) const override {
    return (q - p).head<2>().norm();
  }
  SignatureKey key(const Vector3d& p, const Vector3d& q) const override {
    return key_of<2>(cut_, relative(p), relative(q));
  }

 private:
  static Vector2d relative(const Vector3d& p) { return p.head<2>() - Vector2d(5.0, p.z()); }

  Cuts<2> cut_{{Vector2d::Zero()}};
};

TEST(VisibilityPrmInSpaceTime, PassesBeforeAndBehindAMovingDisc) {
  const CrossedPlane space;
  const Vector3d start(1.0, 5.0, 0.0);
  const Vector3d goal(9.0, 5.0, 10.0);
  const Roadmap<3> roadmap = visibility_prm<3>(space, start, goal, prm_options());
  for (const auto& edge : roadmap.edges) {
    const Vector3d p = roadmap.nodes[edge.from].position;
    const Vector3d q = roadmap.nodes[edge.to].position;
    ASSERT_TRUE(space.in_order(p, q));
    ASSERT_TRUE(space.clearance_m(p, q));
    ASSERT_EQ(edge.length_m, space.length_m(p, q));
  }
  const auto classes = shortest_of_each_class<3>(roadmap, space, 20.0, true);
  for (const double early : {1.0, -1.0}) {
    const Vector3d middle(5.0, 5.0, 5.0 - 2.5 * early);
    const SignatureKey key = space.key(start, middle) + space.key(middle, goal);
    ASSERT_EQ(classes.count(key), 1u) << early;
    EXPECT_LT(classes.at(key), 10.0);
  }
}

}  // namespace
}  // namespace mocha
