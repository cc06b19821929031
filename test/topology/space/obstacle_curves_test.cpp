#include "topology/space/obstacle_curves.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
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

/// The open voxels that can be reached from one of them, each with the one from which it was.
std::map<int, int> open_tree(const SolidVoxels& voxels) {
  std::map<int, int> from;
  std::vector<int> queue;
  const auto reach = [&](int number, int before) {
    if (voxels.solid[number] == 0 && from.emplace(number, before).second) queue.push_back(number);
  };
  for (int number = 0; queue.empty() && number < static_cast<int>(voxels.solid.size()); ++number)
    reach(number, number);
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      reach(queue[i] + voxels.steps()[axis], queue[i]);
      reach(queue[i] - voxels.steps()[axis], queue[i]);
    }
  }
  return from;
}

/// Closed paths of which all others in what is open are sums.
std::vector<std::vector<Vector3d>> closed_paths(const SolidVoxels& voxels) {
  const std::map<int, int> from = open_tree(voxels);
  const auto to_root = [&](int number) {
    std::vector<Vector3d> path = {voxels.centre(voxels.voxel(number))};
    for (; from.at(number) != number; number = from.at(number))
      path.push_back(voxels.centre(voxels.voxel(from.at(number))));
    return path;
  };
  std::vector<std::vector<Vector3d>> paths;
  for (const auto& [number, before] : from) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto next = from.find(number + voxels.steps()[axis]);
      if (next == from.end() || next->second == number || before == next->first) continue;
      std::vector<Vector3d> path = to_root(number);
      const std::vector<Vector3d> back = to_root(next->first);
      path.insert(path.end(), back.rbegin(), back.rend());
      paths.push_back(std::move(path));
    }
  }
  return paths;
}

/// Bars of voxels along the axes, some of them to the rim; what is enclosed is solid.
SolidVoxels random_bars(std::mt19937& random) {
  constexpr int kSide = 13;
  std::uniform_int_distribution<int> place(0, kSide - 1);
  std::uniform_int_distribution<int> thickness(1, 2);
  std::vector<Eigen::AlignedBox3i> bars;
  for (int i = 0; i < 24; ++i) {
    const Vector3i from(place(random), place(random), place(random));
    Vector3i to = from.array() + thickness(random) - 1;
    to[i % 3] = place(random);
    bars.emplace_back(from.cwiseMin(to), from.cwiseMax(to));
  }
  SolidVoxels voxels = voxel_figure(Vector3i::Constant(kSide), [&](const Vector3i& voxel) {
    return std::any_of(bars.begin(), bars.end(),
                       [&](const auto& bar) { return bar.contains(voxel); });
  });
  const auto open = open_tree(voxels);
  for (std::size_t i = 0; i < voxels.solid.size(); ++i)
    voxels.solid[i] = open.count(static_cast<int>(i)) ? 0 : 1;
  return voxels;
}

/// How many independent closed ways lead around what is solid and what is outside, by the Euler
/// number of both.
int ways_around(const SolidVoxels& voxels) {
  const SolidVoxels with_rim = voxel_figure(voxels.size.array() + 2, [&](const Vector3i& voxel) {
    const Vector3i inner = voxel.array() - 1;
    return !voxels.contains(inner) || voxels.solid[voxels.number(inner)] == 1;
  });
  return parts(with_rim, 1) + parts(with_rim, 0) - euler_number(with_rim);
}

TEST(ObstacleCurves, AreABasisOfAllWaysAround) {
  std::mt19937 random(1);
  int most = 0;
  for (int run = 0; run < 40; ++run) {
    const SolidVoxels voxels = random_bars(random);
    const ObstacleCurves found = obstacle_curves(voxels);
    const int curves = static_cast<int>(found.curves.size());
    most = std::max(most, curves);
    ASSERT_EQ(curves, ways_around(voxels)) << run;
    if (curves == 0) continue;
    std::vector<Signature> signatures;
    for (const auto& path : closed_paths(voxels)) signatures.push_back(links(found, path));
    Eigen::MatrixXd rows(signatures.size(), curves);
    for (std::size_t i = 0; i < signatures.size(); ++i)
      for (int k = 0; k < curves; ++k) rows(static_cast<int>(i), k) = signatures[i][k];
    EXPECT_EQ(Eigen::FullPivLU<Eigen::MatrixXd>(rows).rank(), curves) << run;
  }
  EXPECT_GT(most, 5);
}

}  // namespace
}  // namespace mocha
