#include "perception/pose_graph/loop_closer.h"

#include <gtest/gtest.h>

#include "perception/room.h"
#include "trajectory/frame_change.h"

namespace mocha {
namespace {

const LoopCloserOptions kOptions{4.0, 0.75};

/// Two passes through one room; where the second is believed to be is off by `drift`.
class LoopCloserTest : public testing::Test {
 protected:
  static Room office() {
    Room room;
    room.circles = {{{-2.0, 1.0}, 0.3}, {{3.0, -1.0}, 0.4}, {{0.5, 2.0}, 0.2}};
    return room;
  }

  ScanKeyframe seen_from(const Pose& pose) const {
    ScanKeyframe keyframe;
    keyframe.scan = hits_of(beams_at(room_, pose, 20.0, 360), pose, 0.02);
    keyframe.surfels = surfels_of(keyframe.scan, 180);
    return keyframe;
  }

  void pass_first() {
    for (int i = 0; i < 5; ++i) add({{-2.0 + i, -1.5}, 0.0}, {}, 0.01);
  }

  /// The next keyframe of the second pass.
  std::vector<LoopClosure> pass_again(const Pose& truth, const Pose& drift) {
    add(truth, drift, graph_.size() == 5 ? 1.0 : 0.01);
    return closer_.look(graph_, keyframes_, graph_.size() - 1);
  }

  void add(const Pose& truth, const Pose& drift, double sigma_m) {
    const int id = graph_.add_keyframe(composed(drift, truth));
    keyframes_.push_back(seen_from(truth));
    if (id == 0) return;
    const Eigen::Vector3d information(1.0 / (sigma_m * sigma_m), 1.0 / (sigma_m * sigma_m), 1e3);
    graph_.add({id - 1, id, relative(graph_.poses()[id - 1], graph_.poses()[id]),
                information.asDiagonal(), false});
  }

  Room room_ = office();
  PoseGraph graph_;
  std::vector<ScanKeyframe> keyframes_;
  LoopCloser closer_{kOptions};
};

TEST_F(LoopCloserTest, LooksNowhereWhereAllIsSure) {
  for (int i = 0; i < 5; ++i) {
    add({{-2.0 + i, -1.5}, 0.0}, {}, 0.01);
    EXPECT_TRUE(closer_.look(graph_, keyframes_, graph_.size() - 1).empty());
  }
  EXPECT_EQ(closer_.tried(), 0);
}

TEST_F(LoopCloserTest, ClosesALoopThatIsNearlyClosedAtOnce) {
  pass_first();
  const Pose truth{{0.0, 0.5}, 2.0};
  const auto loops = pass_again(truth, {{0.2, -0.1}, 0.03});
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(loops[0].keyframe, 5);
  EXPECT_LT((loops[0].place.pose.position - truth.position).norm(), 0.02);
  EXPECT_LT(std::abs(wrap_angle(loops[0].place.pose.yaw_rad - truth.yaw_rad)), 0.01);
}

TEST_F(LoopCloserTest, BelievesAPlaceFarFromTheExpectedOneWhenItIsFoundTwice) {
  pass_first();
  const Pose drift{{1.5, -0.8}, 0.1};
  EXPECT_TRUE(pass_again({{0.0, 0.5}, 2.0}, drift).empty());
  const Pose next{{-0.3, 0.9}, 2.2};
  const auto loops = pass_again(next, drift);
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_EQ(loops[0].keyframe, 5);
  EXPECT_EQ(loops[1].keyframe, 6);
  EXPECT_LT((loops[1].place.pose.position - next.position).norm(), 0.02);
}

TEST_F(LoopCloserTest, TakesWhatOnlyFurtherKeyframesCouldHaveConfirmed) {
  pass_first();
  EXPECT_TRUE(closer_.take_unconfirmed().empty());
  EXPECT_TRUE(pass_again({{0.0, 0.5}, 2.0}, {{1.5, -0.8}, 0.1}).empty());
  EXPECT_EQ(closer_.take_unconfirmed().size(), 1u);
  EXPECT_TRUE(closer_.take_unconfirmed().empty());
}

TEST_F(LoopCloserTest, ClosesNoLoopInAnotherRoom) {
  pass_first();
  room_.low = {-1.0, -6.0};
  room_.high = {1.5, 1.0};
  room_.circles = {{{0.6, -3.0}, 0.3}};
  for (int i = 0; i < 4; ++i)
    EXPECT_TRUE(pass_again({{0.0, -4.0 + i}, 1.5}, {{0.5, 0.5}, 0.1}).empty());
  EXPECT_GT(closer_.tried(), 0);
  EXPECT_TRUE(closer_.take_unconfirmed().empty());
}

/// A place that looks the same a little farther on cannot be told from it.
TEST_F(LoopCloserTest, ClosesNoLoopAlongABareCorridor) {
  room_.low = {-60.0, -2.5};
  room_.high = {60.0, -0.5};
  room_.circles.clear();
  pass_first();
  for (int i = 0; i < 4; ++i)
    EXPECT_TRUE(pass_again({{2.0 - i, -1.4}, M_PI}, {{1.0, 0.1}, 0.05}).empty());
  EXPECT_GT(closer_.tried(), 0);
}

}  // namespace
}  // namespace mocha
