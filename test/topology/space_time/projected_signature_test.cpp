#include "topology/space_time/projected_signature.h"

#include <gtest/gtest.h>

#include "topology/paths/euclidean_shortcutting.h"
#include "topology/roadmaps/visibility_prm.h"
#include "topology/shipped_options.h"
#include "topology/signatures/signature_sums.h"
#include "world/primitive_field.h"

namespace mocha {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr double kMaxSpeed = 2.0;
constexpr double kSpan_s = 5.0;
constexpr double kClearance_m = 0.01;

struct World {
  PrimitiveField<3> field{{}, 1.0};
  Cuts<3> cuts{{}};
  std::vector<Tube<3>> balls;

  SpaceTime<3> space() const {
    return {field,
            cuts,
            {Vector3d(-9.0, -9.0, -9.0), Vector3d(9.0, 9.0, 9.0)},
            {Vector3d(-2.5, 0.0, 0.0), Vector3d(2.5, 0.0, 0.0), 0.0, kSpan_s},
            kMaxSpeed,
            balls,
            {0.2, 0.0}};
  }
};

/// A ball of 0.5 m that stands in the middle or crosses it.
Tube<3> ball(const Vector3d& velocity) {
  return {{0.0, kSpan_s, -0.5 * kSpan_s * velocity, velocity, 0.5, 0.0}};
}

/// By way of a place at half time.
std::vector<Vector4d> path_via(const SpaceTime<3>& space, const Vector3d& place) {
  return {space.start(), space.point(place, 0.5 * kSpan_s), space.goal()};
}

TEST(ProjectedSignature, AbstainsWhereThePathEntersAShadow) {
  World world;
  world.balls = {ball(Vector3d::Zero())};
  const SpaceTime<3> space = world.space();
  const auto of = [&](const Vector3d& place) {
    return projected_signature(space, path_via(space, place), kClearance_m);
  };
  const ProjectedSignature left = of({0.0, 1.0, 0.0});
  const ProjectedSignature right = of({0.0, -1.0, 0.0});
  const ProjectedSignature above = of({0.0, 0.0, 1.0});
  // In (x, y) over the ball is through its shadow; in (x, z) so is beside it.
  ASSERT_EQ(left.size(), 3u);
  EXPECT_TRUE(left[0] && right[0] && !above[0]);
  EXPECT_TRUE(!left[1] && !right[1] && above[1]);
  EXPECT_TRUE(!left[2] && !right[2] && !above[2]);  // from the front all begin behind the ball
  EXPECT_TRUE(differ(left, right));
  EXPECT_FALSE(differ(left, above));
  EXPECT_FALSE(differ(left, left));
  const ProjectedSignature corner = of({0.0, 1.0, 1.0});
  EXPECT_TRUE(corner[0] && corner[1]);
  EXPECT_FALSE(differ(corner, left));
  EXPECT_TRUE(differ(corner, right));
  // How much room is asked for decides which abstain.
  const std::vector<Vector4d> close = path_via(space, {0.0, 0.6, 0.0});
  EXPECT_TRUE(projected_signature(space, close, 0.05)[0]);
  EXPECT_FALSE(projected_signature(space, close, 0.2)[0]);
}

TEST(ProjectedSignature, IsThatOfThePlaneForWhatSpansTheAxis) {
  // A person seen from above: the winding in (x, y) alone tells before from behind.
  World world;
  world.balls = {ball({0.0, 1.0, 0.0})};
  const SpaceTime<3> space = world.space();
  const std::vector<Vector4d> before = {space.start(), space.point({1.5, 0.0, 0.0}, 2.2),
                                        space.goal()};
  const std::vector<Vector4d> behind = {space.start(), space.point({-1.5, 0.0, 0.0}, 2.8),
                                        space.goal()};
  EXPECT_TRUE(differ(projected_signature(space, before, kClearance_m),
                     projected_signature(space, behind, kClearance_m)));
}

TEST(ProjectedSignature, ColumnsNeverAbstain) {
  World world;
  world.field = PrimitiveField<3>({Cylinder{{0.0, 0.0}, 0.3}}, 1.0);
  world.cuts = Cuts<3>({Column{{0.0, 0.0}}});
  const SpaceTime<3> space = world.space();
  const auto left = projected_signature(space, path_via(space, {0.0, 1.0, 0.0}), kClearance_m);
  const auto right = projected_signature(space, path_via(space, {0.0, -1.0, 0.0}), kClearance_m);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_TRUE(differ(left, right));
}

/// Paths past balls in space and time: possible, and pairwise different.
std::vector<ClassPath<4>> paths_through(const World& world, int samples) {
  const SpaceTime<3> space = world.space();
  const Roadmap<4> roadmap =
      visibility_prm<4>(space, space.start(), space.goal(), prm_options(samples));
  std::vector<ClassPath<4>> paths = shortest_classes<4>(roadmap, space, {30, 1.5});
  for (const ClassPath<4>& path : paths)
    EXPECT_EQ(space.signature_of(with_shortcuts<4>(path.points, space)),
              space.signature_of(path.points));
  paths = pairwise_different(std::move(paths), space, kClearance_m);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const auto& points = paths[i].points;
    for (std::size_t k = 1; k < points.size(); ++k) {
      EXPECT_TRUE(space.in_order(points[k - 1], points[k]));
      for (int share = 0; share <= 100; ++share) {
        const Vector4d p = points[k - 1] + (points[k] - points[k - 1]) * (share / 100.0);
        const double t = space.time_s(p);
        for (const Tube<3>& tube : world.balls) {
          EXPECT_GE((p.head<3>() - tube[0].centre_at(t)).norm(), tube[0].radius_at(t) - 1e-6);
        }
      }
    }
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_TRUE(differ(projected_signature(space, points, kClearance_m),
                         projected_signature(space, paths[j].points, kClearance_m)));
    }
  }
  return paths;
}

TEST(ProjectedSignature, PathsInSpaceAndTimeArePairwiseDifferent) {
  World world;
  EXPECT_EQ(paths_through(world, 500).size(), 1u);  // the straight one
  world.balls = {ball({0.0, 1.0, 0.0})};
  EXPECT_GE(paths_through(world, 500).size(), 2u);
  world.balls = {ball({0.0, 1.0, 0.3}), ball({0.2, -0.5, 0.5})};
  EXPECT_GE(paths_through(world, 500).size(), 2u);
}

}  // namespace
}  // namespace mocha
