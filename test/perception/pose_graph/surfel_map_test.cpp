#include "perception/pose_graph/surfel_map.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "perception/room.h"
#include "trajectory/frame_change.h"

namespace mocha {
namespace {

constexpr double kReach_m = 0.6;

ScanKeyframe seen_in(const Room& room, const Pose& pose) {
  ScanKeyframe keyframe;
  keyframe.scan = hits_of(beams_at(room, pose, 20.0, 360), pose, 0.02);
  keyframe.surfels = surfels_of(keyframe.scan, 1000);
  return keyframe;
}

PoseEstimate roughly(const Pose& pose) {
  return {pose, Eigen::Vector3d(0.04, 0.04, 0.01).asDiagonal()};
}

TEST(SurfelMapTest, FindsTheWayBackFromAPriorThatIsOff) {
  Room room;
  room.circles = {{{-2.0, 1.0}, 0.3}, {{3.0, -1.0}, 0.4}};
  const Pose there{{0.5, -0.3}, 0.4};
  const ScanKeyframe from = seen_in(room, there);
  const SurfelMap map({{7, there, &from}});
  for (const Pose& here : {Pose{{1.0, 0.2}, 0.9}, Pose{{-0.5, -1.0}, -2.0}}) {
    const ScanKeyframe seen = seen_in(room, here);
    const Pose prior{here.position + Vector2(0.15, -0.1), here.yaw_rad + 0.08};
    const Alignment alignment = map.align(seen.surfels, roughly(prior), kReach_m);
    EXPECT_LT((alignment.pose.position - here.position).norm(), 0.01);
    EXPECT_LT(std::abs(wrap_angle(alignment.pose.yaw_rad - here.yaw_rad)), 0.005);
    EXPECT_GT(alignment.explained, 0.9);
    ASSERT_EQ(alignment.agreements.size(), 1u);
    EXPECT_EQ(alignment.agreements[0].keyframe, 7);
  }
}

TEST(SurfelMapTest, KnowsNothingOfTheWayAlongACorridor) {
  Room corridor;
  corridor.low = {-100.0, -1.0};
  corridor.high = {100.0, 1.0};
  const ScanKeyframe from = seen_in(corridor, {{0.0, 0.0}, 0.0});
  const SurfelMap map({{0, {}, &from}});
  const Alignment alignment = map.align(from.surfels, roughly({{0.3, 0.1}, 0.05}), kReach_m);
  EXPECT_NEAR(alignment.pose.position.y(), 0.0, 0.005);
  EXPECT_NEAR(alignment.pose.position.x(), 0.3, 0.02);  // the prior's
  ASSERT_EQ(alignment.agreements.size(), 1u);
  const Eigen::Matrix3d& information = alignment.agreements[0].error.information;
  EXPECT_LT(information(0, 0), 1e-3 * information(1, 1));
}

/// Of two keyframes that are believed to stand a little too far apart, each has its own opinion.
TEST(SurfelMapTest, TellsWhatEachKeyframeSays) {
  const ScanKeyframe from = seen_in(Room(), {});
  ScanKeyframe north;
  ScanKeyframe south;
  for (const Surfel& surfel : from.surfels)
    (surfel.point.y() > 0.0 ? north : south).surfels.push_back(surfel);
  const SurfelMap map({{1, {}, &north}, {2, {{0.06, 0.0}, 0.0}, &south}});
  const Alignment alignment = map.align(from.surfels, roughly({}), kReach_m);
  ASSERT_EQ(alignment.agreements.size(), 2u);
  for (const Agreement& agreement : alignment.agreements) {
    EXPECT_GT(agreement.surfels, 30);
    // Its own opinion is where it stands.
    const Eigen::Vector3d change =
        -agreement.error.information.inverse() * agreement.error.gradient;
    const double own_x_m = alignment.pose.position.x() + change.x();
    EXPECT_NEAR(own_x_m, agreement.keyframe == 1 ? 0.0 : 0.06, 0.005);
  }
}

TEST(SurfelMapTest, KeepsTheSidesOfAThinWallApart) {
  Room left;
  left.high.x() = 0.0;
  Room right;
  right.low.x() = 0.1;
  const Pose here{{-2.0, 0.0}, 0.0};
  const Pose there{{2.0, 0.0}, 0.0};
  const ScanKeyframe from = seen_in(left, here);
  const ScanKeyframe seen = seen_in(right, there);
  const SurfelMap map({{0, here, &from}});
  const Pose prior{{1.9, 0.0}, 0.0};  // as if the wall had no thickness
  const Alignment alignment = map.align(seen.surfels, roughly(prior), kReach_m);
  EXPECT_NEAR(alignment.pose.position.x(), 1.9, 0.02);
  EXPECT_LT(alignment.explained, 0.1);  // that wall is none of those of the map
}

TEST(SurfelMapTest, LeavesAScanWithoutWallsWhereItIsBelievedToBe) {
  const ScanKeyframe from = seen_in(Room(), {});
  const Alignment alignment =
      SurfelMap({{0, {}, &from}}).align({}, roughly({{1.0, 2.0}, 0.3}), kReach_m);
  EXPECT_EQ(alignment.explained, 0.0);
  EXPECT_EQ(alignment.pose.position, Vector2(1.0, 2.0));
  const ScanKeyframe blind;
  EXPECT_EQ(SurfelMap({{0, {}, &blind}}).align(from.surfels, roughly({}), kReach_m).explained, 0.0);
}

}  // namespace
}  // namespace mocha
