#include "planning/promise_builder.h"

#include <gtest/gtest.h>

#include "fleet/wire_format.h"
#include "planning/worlds.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kStart_s = 1.7e9 + 0.5;

class PromiseBuilderTest : public ::testing::Test {
 protected:
  PromiseScene scene(const OccupancyGrid& grid) const {
    return {occupied_field(grid), unseen_field(grid), {}};
  }

  /// Where the promise comes to rest.
  static Vector2 end(const CertifiedMotion& promise) { return promise.motion.end_pose().position; }

  void expect_promise(const CertifiedMotion& promise, const PromiseScene& scene,
                      double from_s) const {
    const Violation violation = builder_.certify(promise.motion, scene, from_s);
    EXPECT_FALSE(violation) << describe(violation);
    const double end_s = promise.motion.end_time();
    EXPECT_LT(promise.motion.at(end_s - 1e-9).velocity.norm(), 1e-3);  // ends at rest
    for (double t = from_s; t < promise.follows_until_s; t += 0.05) {
      const MotionState expected = ahead_.at(t);
      EXPECT_LT((promise.motion.at(t).pose.position - expected.pose.position).norm(), 1e-5);
      EXPECT_LT((promise.motion.at(t).velocity - expected.velocity).norm(), 1e-5);
    }
  }

  const RobotModel robot_ = rover();
  const PromiseBuilder builder_{robot_};
  const double margin_m_ = MarginBudget::of(robot_).static_margin_m();
  const OccupancyGrid open_ = free_grid({-2.0, -3.0}, {12.0, 3.0});
  const Motion ahead_ = straight_drive(kStart_s, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5);
};

TEST_F(PromiseBuilderTest, PromisesAllOfAShortMotion) {
  const auto promise =
      builder_.longest(ahead_, scene(open_), kStart_s, kStart_s + 0.3, kStart_s + 60.0);
  ASSERT_TRUE(promise);
  EXPECT_EQ(promise->follows_until_s, ahead_.end_time());
  EXPECT_FALSE(promise->cut_by);
  EXPECT_LT((end(*promise) - Vector2(8.0, 0.0)).norm(), 1e-9);
  expect_promise(*promise, scene(open_), kStart_s);
}

TEST_F(PromiseBuilderTest, PromisesNoMoreThanADatagramHolds) {
  const auto& whole = std::get<DrivePhase>(ahead_.phases().front()).path;
  constexpr int kPieces = 200;
  PlanarMinco minco;
  minco.resize(kPieces);
  PlanarMinco::Knots knots(2, kPieces - 1);
  const double piece_s = whole.duration() / kPieces;
  for (int k = 1; k < kPieces; ++k) knots.col(k - 1) = whole.derivative(k * piece_s, 0);
  PlanarMinco::State start;
  PlanarMinco::State end;
  for (int order = 0; order < 3; ++order) {
    start.col(order) = whole.derivative(0.0, order);
    end.col(order) = whole.derivative(whole.duration(), order);
  }
  minco.solve(start, end, knots, Eigen::VectorXd::Constant(kPieces, piece_s));
  const Motion fine(kStart_s, {DrivePhase{1, minco.curve()}});
  ASSERT_FALSE(fits(fine));
  const auto promise =
      builder_.longest(fine, scene(open_), kStart_s, kStart_s + 0.3, kStart_s + 60.0);
  ASSERT_TRUE(promise);
  EXPECT_TRUE(fits(promise->motion));
  EXPECT_GT(promise->follows_until_s, kStart_s + 2.0);
  EXPECT_LT(promise->follows_until_s, fine.end_time());
}

TEST_F(PromiseBuilderTest, CutsAtTheHorizonAndBrakes) {
  for (const double horizon_s : {0.5, 2.0, 4.0, 7.0}) {
    const double now_s = kStart_s + 1.0;
    const auto promise =
        builder_.longest(ahead_, scene(open_), now_s, now_s + 0.3, now_s + horizon_s);
    ASSERT_TRUE(promise);
    EXPECT_DOUBLE_EQ(promise->follows_until_s, now_s + horizon_s);
    EXPECT_FALSE(promise->cut_by);
    EXPECT_LT(end(*promise).x(), 8.0);
    expect_promise(*promise, scene(open_), now_s);
  }
}

TEST_F(PromiseBuilderTest, BrakesBeforeAnObstacleAndNotMuchEarlierThanNeeded) {
  OccupancyGrid grid = open_;
  fill_box(grid, {5.0, -1.0}, {5.5, 1.0});
  const double limit_x = 5.0 - 0.3 - margin_m_;
  const auto promise =
      builder_.longest(ahead_, scene(grid), kStart_s, kStart_s + 0.3, kStart_s + 60.0);
  ASSERT_TRUE(promise);
  EXPECT_EQ(promise->cut_by.term, ViolatedTerm::kClearance);
  EXPECT_LE(end(*promise).x(), limit_x);
  // Braking is tried every 0.1 s: no more than that much way is given away.
  EXPECT_GT(end(*promise).x(), limit_x - 0.15);
  expect_promise(*promise, scene(grid), kStart_s);
}

TEST_F(PromiseBuilderTest, StopsInsideSpaceThatHasBeenSeenFree) {
  OccupancyGrid grid = open_;
  fill_box(grid, {4.0, -3.0}, {12.0, 3.0}, OccupancyGrid::kUnknown);
  const auto promise =
      builder_.longest(ahead_, scene(grid), kStart_s, kStart_s + 0.3, kStart_s + 60.0);
  ASSERT_TRUE(promise);
  EXPECT_EQ(promise->cut_by.term, ViolatedTerm::kUnseenSpace);
  EXPECT_LE(end(*promise).x(),
            4.0 - 0.3);  // the body itself: unseen space is no obstacle that needs a margin
  EXPECT_GT(end(*promise).x(), 4.0 - 0.3 - 0.15);
}

TEST_F(PromiseBuilderTest, OutsideTheMapIsUnseen) {
  const OccupancyGrid small = free_grid({-2.0, -3.0}, {6.0, 3.0});
  const auto promise =
      builder_.longest(ahead_, scene(small), kStart_s, kStart_s + 0.3, kStart_s + 60.0);
  ASSERT_TRUE(promise);
  EXPECT_EQ(promise->cut_by.term, ViolatedTerm::kUnseenSpace);
  EXPECT_LE(end(*promise).x(), 6.0 - 0.3);
}

TEST_F(PromiseBuilderTest, BrakesBeforeACrossingPeer) {
  PromiseScene with_peer = scene(open_);
  const auto crossing = std::make_shared<const Motion>(
      straight_drive(kStart_s + 2.0, {5.0, -2.5}, M_PI / 2.0, 5.0, 0.9, 0.5));
  with_peer.others = {std::make_shared<PeerObstacle>("ugv2", crossing, 0.3)};
  const auto promise =
      builder_.longest(ahead_, with_peer, kStart_s, kStart_s + 0.3, kStart_s + 60.0);
  ASSERT_TRUE(promise);
  EXPECT_EQ(promise->cut_by.term, ViolatedTerm::kSeparation);
  EXPECT_EQ(promise->cut_by.peer, "ugv2");
  EXPECT_LT(end(*promise).x(), 5.0);
  double least = 1e9;
  for (double t = kStart_s; t < kStart_s + 30.0; t += 0.01) {
    least = std::min(least,
                     (promise->motion.at(t).pose.position - crossing->at(t).pose.position).norm());
  }
  EXPECT_GE(least, 0.6 + robot_.peer_clearance_m + MarginBudget::of(robot_).peer_margin_m());
  expect_promise(*promise, with_peer, kStart_s);
}

TEST_F(PromiseBuilderTest, GoesOnBeforeWhoComesFromBehind) {
  PromiseScene behind = scene(open_);
  behind.moving = {std::make_shared<PredictedDisc>("person", kStart_s, Vector2(-1.76, 0.0),
                                                   Vector2(0.9, 0.0), 0.25, 0.0)};
  behind.predicted_until_s = kStart_s + 4.5;
  const double horizon_s = kStart_s + 3.5;
  const Motion cut =
      with_brake(ahead_, ahead_.clean_cut(kStart_s), horizon_s, builder_.deceleration());
  ASSERT_TRUE(builder_.certify(cut, behind, kStart_s)) << "he would run into it where it stops";
  const auto promise = builder_.longest(ahead_, behind, kStart_s, kStart_s + 0.3, horizon_s);
  ASSERT_TRUE(promise);
  EXPECT_GT(promise->follows_until_s, horizon_s);
  EXPECT_LT(promise->follows_until_s, behind.predicted_until_s);
  expect_promise(*promise, behind, kStart_s);
}

TEST_F(PromiseBuilderTest, NothingWhereNotEvenBrakingIsSafe) {
  const double now_s = kStart_s + 4.0;  // at full speed
  const double here_x = ahead_.at(now_s).pose.position.x();
  OccupancyGrid grid = open_;
  fill_box(grid, {here_x + 0.7, -1.0}, {here_x + 1.2, 1.0});
  EXPECT_FALSE(builder_.longest(ahead_, scene(grid), now_s, now_s + 0.3, now_s + 4.0));
  // A second earlier there was time enough.
  EXPECT_TRUE(builder_.longest(ahead_, scene(grid), now_s - 1.5, now_s - 1.2, now_s + 4.0));
}

TEST_F(PromiseBuilderTest, TurnsInPlaceAreNotCut) {
  const TurnPhase turn{{{0.0, 0.0}, -2.0}, 2.0, turn_duration_s(2.0, 1.5, 4.0)};
  const Motion motion(kStart_s,
                      {turn, straight_drive(0.0, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5).phases()[0]});
  const double middle_s = kStart_s + 0.5 * turn.duration_s;
  const auto promise =
      builder_.longest(motion, scene(open_), middle_s, middle_s + 0.1, middle_s + 0.2);
  ASSERT_TRUE(promise);
  EXPECT_EQ(promise->motion.start_time(), kStart_s);
  EXPECT_NEAR(promise->motion.end_pose().yaw_rad, 0.0, 1e-9);
  EXPECT_LT(end(*promise).norm(), 1e-9);
}

TEST_F(PromiseBuilderTest, WhoStandsStillMayGoOnStanding) {
  const Motion stand = standing(kStart_s, {1.0, 0.0}, 0.0);
  const auto promise =
      builder_.longest(stand, scene(open_), kStart_s + 5.0, kStart_s + 5.3, kStart_s + 9.0);
  ASSERT_TRUE(promise);
  EXPECT_LT((end(*promise) - Vector2(1.0, 0.0)).norm(), 1e-9);
}

TEST_F(PromiseBuilderTest, APromiseInForceMayUseUpTheMarginOfTheMap) {
  OccupancyGrid grid = open_;
  fill_box(grid, {3.0, 0.35}, {12.0, 1.0});
  const PromiseScene beside = scene(grid);
  const auto passing = [](double gap_m) {
    return straight_drive(kStart_s, {0.0, 0.05 - gap_m}, 0.0, 8.0, 0.9, 0.5);
  };
  EXPECT_FALSE(builder_.certify(passing(margin_m_ + 0.002), beside, kStart_s));
  EXPECT_TRUE(builder_.certify(passing(margin_m_ - 0.02), beside, kStart_s));
  EXPECT_FALSE(builder_.certify_in_force(passing(margin_m_ - 0.02), beside, kStart_s));
  EXPECT_TRUE(builder_.certify_in_force(passing(margin_m_ - robot_.margins.map_m - 0.005), beside,
                                        kStart_s));
}

TEST_F(PromiseBuilderTest, WhatIsPromisedTodayHoldsTomorrow) {
  PromiseScene with_peer = scene(open_);
  const auto stand = std::make_shared<const Motion>(standing(kStart_s - 9.0, {6.0, 0.4}, 0.0));
  with_peer.others = {std::make_shared<PeerObstacle>("ugv2", stand, 0.3)};
  const auto promise =
      builder_.longest(ahead_, with_peer, kStart_s, kStart_s + 0.3, kStart_s + 60.0);
  ASSERT_TRUE(promise);
  for (double t = kStart_s; t < promise->motion.end_time() + 1.0; t += 0.1) {
    const Violation violation = builder_.certify_in_force(promise->motion, with_peer, t);
    EXPECT_FALSE(violation) << describe(violation);
  }
}

TEST(Remainder, IsWhatIsLeft) {
  const Motion motion = straight_drive(kStart_s, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5);
  const Motion rest = remainder(motion, kStart_s + 3.0);
  EXPECT_EQ(rest.start_time(), kStart_s + 3.0);
  EXPECT_NEAR(rest.end_time(), motion.end_time(), 1e-6);
  for (double t = kStart_s + 3.0; t < motion.end_time(); t += 0.1) {
    EXPECT_LT((rest.at(t).pose.position - motion.at(t).pose.position).norm(), 1e-6);
  }
  const Motion nothing = remainder(motion, motion.end_time() + 5.0);
  EXPECT_EQ(nothing.start_time(), motion.end_time() + 5.0);
  EXPECT_LT((nothing.end_pose().position - Vector2(8.0, 0.0)).norm(), 1e-9);
}

}  // namespace
}  // namespace mocha
