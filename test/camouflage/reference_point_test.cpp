#include "camouflage/reference_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "camouflage/camouflage_map.h"
#include "safety/circle_field.h"
#include "trajectory/motion.h"
#include "world/primitive_field.h"

namespace mocha {
namespace {

using PlanarPoints = Eigen::Matrix2Xd;

const CircleField kOpen({});
constexpr double kSideDepth_m = 1.0;

/// Points at equal steps along a course that changes by `bend(i)` at each.
template <typename Bend>
PlanarPoints path_of(int points, double step_m, const Bend& bend) {
  PlanarPoints path(2, points);
  path.col(0).setZero();
  double course = 0.0;
  for (int i = 1; i < points; ++i) {
    path.col(i) = path.col(i - 1) + step_m * Vector2(std::cos(course), std::sin(course));
    course += bend(i);
  }
  return path;
}

PlanarPoints straight(int points) {
  return path_of(points, 1.0, [](int) { return 0.0; });
}

/// The smallest angle between a ray and a step of the path at its knot [rad].
double smallest_angle(const PlanarPoints& path, const PlanarPoints& references) {
  double least = M_PI;
  for (int k = 1; k + 1 < path.cols(); ++k) {
    const Vector2 ray = (path.col(k) - references.col(k - 1)).normalized();
    for (const Vector2& step :
         {Vector2(path.col(k) - path.col(k - 1)), Vector2(path.col(k + 1) - path.col(k))}) {
      least = std::min(least, std::acos(std::min(1.0, std::abs(ray.dot(step.normalized())))));
    }
  }
  return least;
}

TEST(ReferencePoint, IsTheApexOfTheRightTriangleOverAStraightPath) {
  const auto chosen =
      choose_references(straight(11), CircleField({{{5.0, 0.8}, 0.3}}), kSideDepth_m);
  ASSERT_TRUE(chosen);
  ASSERT_EQ(chosen.references.cols(), 9);
  for (int k = 0; k < 9; ++k) {
    EXPECT_NEAR(chosen.references.col(k).x(), 5.0, 1e-12);
    EXPECT_NEAR(chosen.references.col(k).y(), -5.0, 1e-12);  // away from the obstacle on the left
  }
  const Vector2 to_start = Vector2(0.0, 0.0) - chosen.references.col(0);
  const Vector2 to_goal = Vector2(10.0, 0.0) - chosen.references.col(0);
  EXPECT_NEAR(to_start.dot(to_goal), 0.0, 1e-12);
  EXPECT_NEAR(to_start.norm(), to_goal.norm(), 1e-12);
}

TEST(ReferencePoint, StandsOnTheSideWithFewerObstacles) {
  const CircleField left({{{3.0, 0.8}, 0.3}, {{6.0, 0.9}, 0.3}, {{8.0, -0.9}, 0.2}});
  const CircleField right({{{3.0, -0.8}, 0.3}, {{6.0, -0.9}, 0.3}, {{8.0, 0.9}, 0.2}});
  EXPECT_LT(choose_references(straight(11), left, kSideDepth_m).references.col(4).y(), 0.0);
  EXPECT_GT(choose_references(straight(11), right, kSideDepth_m).references.col(4).y(), 0.0);
}

TEST(ReferencePoint, WindingPathsAreSplitSoThatEveryRayKeepsItsAngle) {
  int split = 0;
  for (int seed = 1; seed <= 200; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0.0, 0.3);
    const auto path = path_of(25, 0.5, [&](int) { return noise(random); });
    const auto chosen = choose_references(path, kOpen, kSideDepth_m);
    ASSERT_TRUE(chosen) << "seed " << seed;
    EXPECT_GE(smallest_angle(path, chosen.references), kLeastRayAngle_rad - 1e-9)
        << "seed " << seed;
    split += (chosen.references.colwise() - chosen.references.col(0)).norm() > 1e-9;
    EXPECT_NO_THROW(CamouflageMap<2>(path.middleCols(1, 23), chosen.references, 1.0));
  }
  EXPECT_GT(split, 50);  // otherwise the test shows nothing
}

TEST(ReferencePoint, UTurnIsSplit) {
  const auto path = path_of(31, 0.3, [](int i) { return i > 10 && i <= 20 ? 0.1 * M_PI : 0.0; });
  const auto chosen = choose_references(path, kOpen, kSideDepth_m);
  ASSERT_TRUE(chosen);
  EXPECT_GE(smallest_angle(path, chosen.references), kLeastRayAngle_rad - 1e-9);
  EXPECT_GT((chosen.references.col(0) - chosen.references.col(28)).norm(), 0.5);
}

TEST(ReferencePoint, ClosedPathsAreSplitToo) {
  const auto circle = path_of(41, 0.4, [](int) { return 2.0 * M_PI / 40.0; });
  ASSERT_LT((circle.col(0) - circle.col(40)).norm(), 1e-9);
  const auto chosen = choose_references(circle, kOpen, kSideDepth_m);
  ASSERT_TRUE(chosen);
  EXPECT_TRUE(chosen.references.allFinite());
  EXPECT_GE(smallest_angle(circle, chosen.references), kLeastRayAngle_rad - 1e-9);
}

TEST(ReferencePoint, WhereThereIsNoneTheFaultSaysWhyAndWhere) {
  const auto expect = [](const PlanarPoints& path, ReferenceFault fault, int knot) {
    const auto chosen = choose_references(path, kOpen, kSideDepth_m);
    EXPECT_FALSE(chosen);
    EXPECT_EQ(chosen.fault, fault);
    EXPECT_EQ(chosen.references.size(), 0);
    for (int axis = 0; axis < 2; ++axis)  // of which one may be no number
      EXPECT_EQ(std::isnan(path(axis, knot)) || chosen.place[axis] == path(axis, knot), true);
  };
  // All points coincide: start = goal.
  expect(PlanarPoints::Zero(2, 6), ReferenceFault::kCoincidentPoints, 1);
  PlanarPoints doubled = straight(8);
  doubled.col(4) = doubled.col(3);
  expect(doubled, ReferenceFault::kCoincidentPoints, 3);
  doubled.col(4) = doubled.col(3) + Vector2(0.4, 0.0);
  EXPECT_TRUE(choose_references(doubled, kOpen, kSideDepth_m));
  PlanarPoints back = straight(5);  // there and straight back: a cusp
  back.row(0) << 0.0, 1.0, 2.0, 1.0, 0.0;
  expect(back, ReferenceFault::kSharpBend, 2);
  PlanarPoints broken = straight(8);
  broken(0, 3) = NAN;
  expect(broken, ReferenceFault::kCoincidentPoints, 2);
}

/// A path along a tilted chord that swings aside in the direction given.
Eigen::Matrix3Xd swinging_path(const Eigen::Vector3d& chord, const Eigen::Vector3d& aside) {
  constexpr int kPoints = 21;
  Eigen::Matrix3Xd path(3, kPoints);
  for (int k = 0; k < kPoints; ++k) {
    const double share = k / (kPoints - 1.0);
    path.col(k) = share * chord + std::sin(2.0 * M_PI * share) * aside;
  }
  return path;
}

TEST(ReferencePoint, InSpaceStandsInThePlaneInWhichThePathSwings) {
  const PrimitiveField<3> open({}, 1.0);
  const Eigen::Vector3d chord(20.0, 10.0, 4.0);
  const Eigen::Vector3d level = chord.cross(Eigen::Vector3d::UnitZ()).normalized();
  const Eigen::Vector3d upward = level.cross(chord).normalized();
  for (const Eigen::Vector3d& aside :
       {level, upward, Eigen::Vector3d(0.6 * level + 0.8 * upward)}) {
    const auto chosen = choose_references(swinging_path(chord, aside), open, kSideDepth_m);
    ASSERT_TRUE(chosen);
    const Eigen::Vector3d apex = chosen.references.col(9) - 0.5 * chord;
    EXPECT_NEAR(apex.norm(), 0.5 * chord.norm(), 1e-9);
    EXPECT_NEAR(std::abs(apex.normalized().dot(aside)), 1.0, 1e-9);
    EXPECT_NEAR(apex.dot(chord), 0.0, 1e-9);
  }
}

TEST(ReferencePoint, InSpaceAStraightPathHasItsReferenceBesideIt) {
  const PrimitiveField<3> tree_on_the_left({{{10.0, 0.8}, 0.3}}, 1.0);
  const auto chosen = choose_references(swinging_path({20.0, 0.0, 0.0}, Eigen::Vector3d::Zero()),
                                        tree_on_the_left, kSideDepth_m);
  ASSERT_TRUE(chosen);
  EXPECT_LT((chosen.references.col(5) - Eigen::Vector3d(10.0, -10.0, 0.0)).norm(), 1e-9);
  const PrimitiveField<3> open({}, 1.0);
  const auto climbing = choose_references(swinging_path({0.0, 0.0, 20.0}, Eigen::Vector3d::Zero()),
                                          open, kSideDepth_m);
  ASSERT_TRUE(climbing);  // there is no level direction of its own
  EXPECT_NEAR(climbing.references.col(5).z(), 10.0, 1e-9);
}

TEST(ReferencePoint, PathsWithoutInteriorKnotsNeedNone) {
  for (const int points : {1, 2}) {
    const auto chosen = choose_references(straight(points), kOpen, kSideDepth_m);
    ASSERT_TRUE(chosen);
    EXPECT_EQ(chosen.references.cols(), 0);
  }
}

}  // namespace
}  // namespace mocha
