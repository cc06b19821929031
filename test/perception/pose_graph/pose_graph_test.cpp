#include "perception/pose_graph/pose_graph.h"

#include <gtest/gtest.h>

#include <cmath>

#include "perception/pose_graph/graph_optimizer.h"
#include "trajectory/frame_change.h"

namespace mocha {
namespace {

Eigen::Matrix3d known_to(double sigma_m, double sigma_rad) {
  return Eigen::Vector3d(1.0 / (sigma_m * sigma_m), 1.0 / (sigma_m * sigma_m),
                         1.0 / (sigma_rad * sigma_rad))
      .asDiagonal();
}

/// Keyframes in a row, 1 m apart.
PoseGraph row(int keyframes, const Eigen::Matrix3d& information) {
  PoseGraph graph;
  for (int i = 0; i < keyframes; ++i) {
    graph.add_keyframe({{i * 1.0, 0.0}, 0.0});
    if (i > 0) graph.add({i - 1, i, {{1.0, 0.0}, 0.0}, information, false});
  }
  return graph;
}

TEST(PoseGraphTest, UncertaintyGrowsAlongTheWay) {
  const PoseGraph graph = row(4, known_to(0.1, 0.05));
  const auto known = graph.uncertainties(0, 10.0);
  double position_m2 = 0.0;
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(known[i].is_known);
    EXPECT_NEAR(known[i].position_variance_m2, position_m2, 1e-12);
    EXPECT_NEAR(known[i].yaw_variance_rad2, i * 0.0025, 1e-12);
    position_m2 += 2 * 0.01 + i * 0.0025;
  }
}

TEST(PoseGraphTest, TheBestKnownWayCounts) {
  PoseGraph graph = row(10, known_to(0.1, 0.01));
  graph.add({0, 9, {{9.0, 0.0}, 0.0}, known_to(0.02, 0.001), true});
  const auto known = graph.uncertainties(0, 10.0);
  EXPECT_NEAR(known[9].position_variance_m2, 2 * 0.0004, 1e-12);
  EXPECT_LT(known[8].position_variance_m2, known[5].position_variance_m2);
}

TEST(PoseGraphTest, WhatIsNotConnectedOrNotSureIsNotKnown) {
  PoseGraph graph = row(5, known_to(0.1, 0.001));
  graph.add_keyframe({{0.5, 0.0}, 0.0});
  const auto known = graph.uncertainties(0, 0.25);
  EXPECT_TRUE(known[3].is_known);   // sqrt(3 * 0.02) = 0.245
  EXPECT_FALSE(known[4].is_known);  // 0.283
  EXPECT_FALSE(known[5].is_known);
  EXPECT_EQ(graph.surely_near(0, 0.25, 10.0), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(graph.surely_near(0, 0.25, 1.5), (std::vector<int>{0, 1}));
  EXPECT_EQ(graph.surely_near(3, 0.25, 10.0), (std::vector<int>{3, 2, 4, 1, 0}));
}

/// A square of 40 keyframes, whose odometry turns too little.
PoseGraph square(double turn_factor, std::vector<Pose>& truth) {
  PoseGraph graph;
  Pose believed;
  Pose true_pose;
  for (int i = 0; i < 40; ++i) {
    if (i > 0) {
      const Pose step{{1.0, 0.0}, i % 10 == 0 ? M_PI_2 : 0.0};
      const Pose seen{step.position, turn_factor * step.yaw_rad};
      believed = composed(believed, seen);
      true_pose = composed(true_pose, step);
      graph.add_keyframe(believed);
      graph.add({i - 1, i, seen, known_to(0.03, 0.1), true});
    } else {
      graph.add_keyframe(believed);
    }
    truth.push_back(true_pose);
  }
  return graph;
}

double farthest_m(const PoseGraph& graph, const std::vector<Pose>& truth) {
  double far_m = 0.0;
  for (int i = 0; i < graph.size(); ++i)
    far_m = std::max(far_m, (graph.poses()[i].position - truth[i].position).norm());
  return far_m;
}

TEST(GraphOptimizerTest, ClosesALoop) {
  std::vector<Pose> truth;
  PoseGraph graph = square(0.95, truth);
  EXPECT_GT(farthest_m(graph, truth), 2.0);
  graph.add({39, 0, relative(truth[39], truth[0]), known_to(0.02, 0.01), true});
  optimize(graph);
  EXPECT_LT(farthest_m(graph, truth), 0.5);
  EXPECT_EQ(graph.poses()[0].position, Vector2(0.0, 0.0));
  EXPECT_EQ(graph.poses()[0].yaw_rad, 0.0);
}

TEST(GraphOptimizerTest, OneWrongLoopAmongRightOnesHasLittleSay) {
  std::vector<Pose> truth;
  PoseGraph graph = square(0.95, truth);
  graph.add({39, 0, relative(truth[39], truth[0]), known_to(0.02, 0.01), true});
  graph.add({38, 1, relative(truth[38], truth[1]), known_to(0.02, 0.01), true});
  graph.add({30, 9, relative(truth[30], truth[9]), known_to(0.02, 0.01), true});
  graph.add({25, 5, {{0.3, 0.2}, 0.1}, known_to(0.02, 0.01), true});  // is 10 m away
  optimize(graph);
  EXPECT_LT(farthest_m(graph, truth), 0.7);
}

/// No small change of any pose makes the sum of all squared errors smaller.
TEST(GraphOptimizerTest, ComesToAMinimum) {
  PoseGraph graph = row(5, known_to(0.1, 0.05));
  graph.add({4, 0, {{-3.7, 0.4}, 0.2}, known_to(0.05, 0.02), false});
  graph.add({1, 3, {{2.0, 0.1}, -0.1}, known_to(0.2, 0.03), false});
  optimize(graph);
  const auto cost = [&](const std::vector<Pose>& poses) {
    double sum = 0.0;
    for (const Constraint& each : graph.constraints()) {
      const Pose is = relative(poses[each.from], poses[each.to]);
      Eigen::Vector3d error;
      error << is.position - each.relative.position, wrap_angle(is.yaw_rad - each.relative.yaw_rad);
      sum += error.dot(each.information * error);
    }
    return sum;
  };
  const double least = cost(graph.poses());
  for (std::size_t i = 1; i < 5; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double by : {-1e-3, 1e-3}) {
        std::vector<Pose> poses = graph.poses();
        (axis == 0   ? poses[i].position.x()
         : axis == 1 ? poses[i].position.y()
                     : poses[i].yaw_rad) += by;
        EXPECT_GT(cost(poses), least);
      }
    }
  }
}

TEST(GraphOptimizerTest, TakesAGraphWithNothingInIt) {
  PoseGraph graph;
  optimize(graph);
  graph.add_keyframe({{1.0, 2.0}, 3.0});
  optimize(graph);
  EXPECT_EQ(graph.poses()[0].position, Vector2(1.0, 2.0));
}

}  // namespace
}  // namespace mocha
