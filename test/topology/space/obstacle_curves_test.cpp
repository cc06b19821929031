#include "topology/space/obstacle_curves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <variant>

#include "topology/space/voxel_figures.h"

namespace mocha {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr int kSize = 21;

ObstacleCurves curves_of(const std::function<bool(const Vector3i&)>& is_solid) {
  return obstacle_curves(voxel_figure(Vector3i::Constant(kSize), is_solid));
}

/// How often a closed path winds about the curves.
Signature links(const ObstacleCurves& found, std::vector<Vector3d> path) {
  path.push_back(path.front());
  return signature_of<3>(Cuts<3>(found.curves), path);
}

bool is_in_wall(const Vector3i& voxel) { return voxel.x() >= 9 && voxel.x() <= 11; }

TEST(ObstacleCurves, APillarFromFloorToCeilingIsAColumn) {
  const auto found = curves_of(
      [](const Vector3i& voxel) { return std::hypot(voxel.x() - 10, voxel.y() - 8) < 2.5; });
  ASSERT_EQ(found.curves.size(), 1u);
  const auto* column = std::get_if<Column>(&found.curves.front());
  ASSERT_NE(column, nullptr);
  EXPECT_LT((column->foot - Eigen::Vector2d(10.5, 8.5)).norm(), 2.0);
  EXPECT_EQ(std::abs(links(found, {{4, 4, 9}, {16, 4, 9}, {16, 14, 12}, {4, 14, 12}})[0]), 1);
  EXPECT_EQ(links(found, {{14, 4, 9}, {18, 4, 9}, {18, 14, 12}, {14, 14, 12}})[0], 0);
}

TEST(ObstacleCurves, APillarThatEndsBelowTheCeilingTellsNothingApart) {
  const auto found = curves_of([](const Vector3i& voxel) {
    return std::hypot(voxel.x() - 10, voxel.y() - 8) < 2.5 && voxel.z() < 15;
  });
  EXPECT_TRUE(found.curves.empty());
  EXPECT_EQ(found.bodies, 0);
}

TEST(ObstacleCurves, ARingIsALoop) {
  const auto found =
      curves_of([](const Vector3i& voxel) { return in_ring(voxel, kSize, 6.0, 1.8); });
  ASSERT_EQ(found.curves.size(), 1u);
  ASSERT_NE(std::get_if<Loop>(&found.curves.front()), nullptr);
  EXPECT_EQ(std::abs(links(found, {{2, 10, 10}, {19, 10, 10}, {19, 20, 10}, {2, 20, 10}})[0]), 1);
  EXPECT_EQ(links(found, {{2, 20, 10}, {19, 20, 10}, {19, 20, 20}, {2, 20, 20}})[0], 0);
}

TEST(ObstacleCurves, BetweenTwoWindowsThereIsAnArch) {
  const auto found = curves_of([](const Vector3i& voxel) {
    const bool is_in_window =
        voxel.z() >= 8 && voxel.z() <= 13 &&
        ((voxel.y() >= 3 && voxel.y() <= 7) || (voxel.y() >= 13 && voxel.y() <= 17));
    return is_in_wall(voxel) && !is_in_window;
  });
  ASSERT_EQ(found.curves.size(), 1u);
  EXPECT_EQ(std::get_if<Loop>(&found.curves.front()), nullptr);
  EXPECT_EQ(std::abs(links(found, {{2, 5, 11}, {19, 5, 11}, {19, 15, 11}, {2, 15, 11}})[0]), 1);
  EXPECT_EQ(links(found, {{2, 5, 11}, {19, 5, 11}, {19, 6, 9}, {2, 6, 9}})[0], 0);
}

TEST(ObstacleCurves, ABeamFromFloorToWallIsAnArchThatLinksWhatGoesUnderIt) {
  const auto found = curves_of([](const Vector3i& voxel) {
    const bool is_post = voxel.x() == 10 && voxel.y() == 10 && voxel.z() <= 10;
    const bool is_beam = voxel.x() >= 10 && voxel.y() == 10 && voxel.z() == 10;
    return is_post || is_beam;
  });
  ASSERT_EQ(found.curves.size(), 1u);
  EXPECT_NE(std::get_if<Arch>(&found.curves.front()), nullptr);
  // Under the beam to the other side, and back above it.
  EXPECT_EQ(std::abs(links(found, {{15, 5, 5}, {15, 16, 5}, {15, 16, 15}, {15, 5, 15}})[0]), 1);
  // Around the post.
  EXPECT_EQ(std::abs(links(found, {{6, 6, 5}, {14, 6, 5}, {14, 14, 5}, {6, 14, 5}})[0]), 1);
  // Above both.
  EXPECT_EQ(links(found, {{6, 6, 15}, {14, 6, 15}, {14, 14, 15}, {6, 14, 15}})[0], 0);
}

TEST(ObstacleCurves, OfAFrameWithTwoWindowsThatHangsFreeThereAreTwoCurves) {
  const auto found = curves_of([](const Vector3i& voxel) {
    const bool is_in_frame = voxel.z() >= 4 && voxel.z() <= 16 && voxel.y() >= 2 && voxel.y() <= 18;
    const bool is_in_window =
        voxel.z() >= 7 && voxel.z() <= 13 &&
        ((voxel.y() >= 4 && voxel.y() <= 8) || (voxel.y() >= 12 && voxel.y() <= 16));
    return is_in_wall(voxel) && is_in_frame && !is_in_window;
  });
  ASSERT_EQ(found.curves.size(), 2u);
  const Signature one = links(found, {{2, 6, 10}, {19, 6, 10}, {19, 20, 10}, {2, 20, 10}});
  const Signature other = links(found, {{2, 14, 10}, {19, 14, 10}, {19, 20, 10}, {2, 20, 10}});
  const Signature around = links(found, {{2, 1, 10}, {19, 1, 10}, {19, 20, 10}, {2, 20, 10}});
  EXPECT_NE(one, other);
  EXPECT_NE(one, around);
  EXPECT_NE(other, around);
  EXPECT_EQ(around, Signature(2, 0));
}

TEST(ObstacleCurves, APostAndALegThatABeamJoinsAreTwo) {
  const auto found = curves_of([](const Vector3i& voxel) {
    const bool is_post = voxel.x() == 10 && voxel.y() == 10;
    const bool is_beam = voxel.x() >= 10 && voxel.x() <= 15 && voxel.y() == 10 && voxel.z() == 15;
    const bool is_leg = voxel.x() == 15 && voxel.y() == 10 && voxel.z() <= 15;
    return is_post || is_beam || is_leg;
  });
  ASSERT_EQ(found.curves.size(), 2u);
  const Signature post = links(found, {{7, 7, 18}, {13, 7, 18}, {13, 14, 18}, {7, 14, 18}});
  const Signature leg = links(found, {{13, 7, 5}, {18, 7, 5}, {18, 14, 5}, {13, 14, 5}});
  const Signature both = links(found, {{7, 7, 5}, {18, 7, 5}, {18, 14, 5}, {7, 14, 5}});
  const Signature none(2, 0);
  EXPECT_NE(post, none);
  EXPECT_NE(leg, none);
  EXPECT_NE(both, leg);
  EXPECT_EQ(both, post);  // above the beam one goes around the post as below it around both
}

TEST(ObstacleCurves, WhatIsNoCurveIsCounted) {
  const auto found = curves_of([](const Vector3i& voxel) {
    return (voxel - Vector3i(6, 6, 6)).norm() < 3.0 || (voxel - Vector3i(15, 15, 12)).norm() < 4.0;
  });
  EXPECT_TRUE(found.curves.empty());
  EXPECT_EQ(found.bodies, 2);
  EXPECT_EQ(found.surface_voxels, 0);
  // A hollow ball, the inside of which counts as open.
  const auto hollow = curves_of([](const Vector3i& voxel) {
    const double away = (voxel - Vector3i::Constant(10)).norm();
    return away > 5.0 && away < 8.0;
  });
  EXPECT_TRUE(hollow.curves.empty());
  EXPECT_GT(hollow.surface_voxels, 20);
}

TEST(ObstacleCurves, AsManyAsThereAreWaysThroughAGrating) {
  // Of four by four openings, fifteen are independent.
  const auto found = curves_of([](const Vector3i& voxel) {
    const bool is_bar = voxel.y() % 5 == 0 || voxel.z() % 5 == 0;
    return voxel.x() == 10 && is_bar;
  });
  EXPECT_EQ(found.curves.size(), 15u);
}

}  // namespace
}  // namespace mocha
