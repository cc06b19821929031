#include "planning/replanner/certified_part.h"

#include <gtest/gtest.h>

#include "fleet/wire/wire_format.h"
#include "planning/maneuver_test.h"
#include "trajectory/splice.h"
#include "trajectory/stopping.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

constexpr double kStart_s = 1.7e9 + 0.5;

class CertifiedPartTest : public ManeuverTest {
 protected:
  /// Of what is committed, when braking begins in a window of time.
  std::optional<CertifiedPart> longest(const Motion& committed, const LocalScene& scene,
                                       double now_s, double earliest_s, double latest_s,
                                       bool at_once = false) const {
    const ManeuverStart start = start_of(committed, scene, now_s);
    const Maneuver goes_on{now_s,      rest_of(committed, now_s), earliest_s, latest_s,
                           earliest_s, robot_.braking(),          at_once,    Follows::kCommitted,
                           "goes on"};
    return certified_part(start, goes_on, RequirementName::kPromise);
  }

  /// Where the promise comes to rest.
  static Vector2 end(const CertifiedPart& promise) { return promise.motion.end_pose().position; }

  void expect_promise(const CertifiedPart& promise, const LocalScene& scene, double from_s) const {
    const Violation violation =
        violation_of(promise.motion, scene, RequirementName::kPromise, from_s);
    EXPECT_FALSE(violation) << describe(violation);
    const double end_s = promise.motion.end_time();
    EXPECT_LT(promise.motion.at(end_s - 1e-9).velocity.norm(), 1e-3);  // ends at rest
    for (double t = from_s; t < promise.follows_until_s; t += 0.05) {
      const MotionState expected = ahead_.at(t);
      EXPECT_LT((promise.motion.at(t).pose.position - expected.pose.position).norm(), 1e-4);
      EXPECT_LT((promise.motion.at(t).velocity - expected.velocity).norm(), 1e-4);
    }
  }

  /// What is committed: to brake along the way, soon.
  Motion stop_soon(double now_s) const {
    return try_brake(ahead_, kStart_s, now_s + 0.2, robot_.braking()).motion;
  }

  const double margin_m_ = MarginBudget::of(robot_).static_margin().still_m;
  const OccupancyGrid open_ = free_grid({-2.0, -3.0}, {12.0, 3.0});
  const Motion ahead_ = straight_drive(kStart_s, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5);
};

TEST_F(CertifiedPartTest, PromisesAllOfAShortMotion) {
  const LocalScene scene = scene_of(open_);
  const auto promise = longest(ahead_, scene, kStart_s, kStart_s + 0.3, kStart_s + 60.0);
  ASSERT_TRUE(promise);
  EXPECT_NEAR(promise->follows_until_s, ahead_.end_time(), 1e-6);
  EXPECT_FALSE(promise->cut_by);
  EXPECT_LT((end(*promise) - Vector2(8.0, 0.0)).norm(), 1e-5);
  expect_promise(*promise, scene, kStart_s);
}

TEST_F(CertifiedPartTest, LeadsNoFartherFromTheRobotThanItMayPromise) {
  const LocalScene scene = scene_of(open_);
  for (const double now_s : {kStart_s, kStart_s + 2.0, kStart_s + 5.0}) {
    const Motion committed = stop_soon(now_s);
    ManeuverStart start = start_of(committed, scene, now_s);
    start.promise_reach_m = 5.0;
    const Maneuver follows{now_s + 0.1,      ahead_, now_s + 0.1,    now_s + 60.0, now_s,
                           robot_.braking(), false,  Follows::kPlan, "follows"};
    const auto promise = certified_part(start, follows, RequirementName::kPromise);
    ASSERT_TRUE(promise) << now_s;
    const Vector2 here = ahead_.position(now_s);
    const double leads_m = (end(*promise) - here).norm();
    EXPECT_LE(leads_m, 5.0);
    EXPECT_GT(leads_m, std::min(4.8, 8.0 - here.x() - 0.01)) << now_s;
    EXPECT_FALSE(violation_of(promise->motion, scene, RequirementName::kPromise,
                              promise->motion.start_time()));
  }
}

TEST_F(CertifiedPartTest, PromisesNoMoreThanADatagramHolds) {
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
  const LocalScene scene = scene_of(open_);
  const auto promise = longest(fine, scene, kStart_s, kStart_s + 0.3, kStart_s + 60.0);
  ASSERT_TRUE(promise);
  EXPECT_TRUE(fits(promise->motion));
  EXPECT_GT(promise->follows_until_s, kStart_s + 2.0);
  EXPECT_LT(promise->follows_until_s, fine.end_time());
}

TEST_F(CertifiedPartTest, CutsAtTheHorizonAndBrakes) {
  const LocalScene scene = scene_of(open_);
  for (const double horizon_s : {0.5, 2.0, 4.0, 7.0}) {
    const double now_s = kStart_s + 1.0;
    const auto promise = longest(ahead_, scene, now_s, now_s + 0.3, now_s + horizon_s);
    ASSERT_TRUE(promise);
    EXPECT_DOUBLE_EQ(promise->follows_until_s, now_s + horizon_s);
    EXPECT_FALSE(promise->cut_by);
    EXPECT_LT(end(*promise).x(), 8.0);
    expect_promise(*promise, scene, now_s);
  }
}

TEST_F(CertifiedPartTest, BrakesBeforeAnObstacleAndNotMuchEarlierThanNeeded) {
  OccupancyGrid grid = open_;
  fill_box(grid, {5.0, -1.0}, {5.5, 1.0});
  const LocalScene scene = scene_of(grid);
  const double limit_x = 5.0 - 0.3 - margin_m_;
  const auto promise = longest(ahead_, scene, kStart_s, kStart_s + 0.3, kStart_s + 60.0);
  ASSERT_TRUE(promise);
  EXPECT_EQ(promise->cut_by.term, ViolatedTerm::kClearance);
  EXPECT_LE(end(*promise).x(), limit_x);
  // Braking is tried every 0.1 s: no more than that much way is given away.
  EXPECT_GT(end(*promise).x(), limit_x - 0.15);
  expect_promise(*promise, scene, kStart_s);
}

TEST_F(CertifiedPartTest, StopsInsideSpaceThatHasBeenSeenFree) {
  OccupancyGrid grid = open_;
  fill_box(grid, {4.0, -3.0}, {12.0, 3.0}, OccupancyGrid::kUnknown);
  const LocalScene scene = scene_of(grid);
  const double limit_x = 4.0 - 0.3 - margin_m_;
  const auto promise = longest(ahead_, scene, kStart_s, kStart_s + 0.3, kStart_s + 60.0);
  ASSERT_TRUE(promise);
  EXPECT_EQ(promise->cut_by.term, ViolatedTerm::kUnseenSpace);
  EXPECT_LE(end(*promise).x(), limit_x);
  EXPECT_GT(end(*promise).x(), limit_x - 0.15);
}

TEST_F(CertifiedPartTest, OutsideTheMapIsUnseen) {
  const LocalScene small = scene_of(free_grid({-2.0, -3.0}, {6.0, 3.0}));
  const auto promise = longest(ahead_, small, kStart_s, kStart_s + 0.3, kStart_s + 60.0);
  ASSERT_TRUE(promise);
  EXPECT_EQ(promise->cut_by.term, ViolatedTerm::kUnseenSpace);
  EXPECT_LE(end(*promise).x(), 6.0 - 0.3 - margin_m_);
}

TEST_F(CertifiedPartTest, BrakesBeforeACrossingPeer) {
  LocalScene with_peer = scene_of(open_);
  const Motion crossing = straight_drive(kStart_s + 2.0, {5.0, -2.5}, M_PI / 2.0, 5.0, 0.9, 0.5);
  with_peer.peers = {peer(crossing)};
  const auto promise = longest(ahead_, with_peer, kStart_s, kStart_s + 0.3, kStart_s + 60.0);
  ASSERT_TRUE(promise);
  EXPECT_EQ(promise->cut_by.term, ViolatedTerm::kSeparation);
  EXPECT_EQ(promise->cut_by.peer, "ugv2");
  EXPECT_LT(end(*promise).x(), 5.0);
  double least = 1e9;
  for (double t = kStart_s; t < kStart_s + 30.0; t += 0.01) {
    least = std::min(least,
                     (promise->motion.at(t).pose.position - crossing.at(t).pose.position).norm());
  }
  EXPECT_GE(least, 0.6 + robot_.peer_clearance_m + MarginBudget::of(robot_).peer_margin_m());
  expect_promise(*promise, with_peer, kStart_s);
}

TEST_F(CertifiedPartTest, GoesOnBeforeWhatComesFromBehind) {
  LocalScene behind = scene_of(open_);
  behind.confident = {person(kStart_s, {-1.76, 0.0}, {0.9, 0.0})};
  behind.predicted_until_s = kStart_s + 4.5;
  const double horizon_s = kStart_s + 3.5;
  const Motion cut = with_brake(ahead_, ahead_.clean_cut(kStart_s), horizon_s, robot_.braking());
  ASSERT_TRUE(violation_of(cut, behind, RequirementName::kPromise, kStart_s))
      << "it would be run into where it stops";
  const auto promise = longest(ahead_, behind, kStart_s, kStart_s + 0.3, horizon_s);
  ASSERT_TRUE(promise);
  EXPECT_GT(promise->follows_until_s, horizon_s);
  EXPECT_LT(promise->follows_until_s, behind.predicted_until_s);
  expect_promise(*promise, behind, kStart_s);
}

TEST_F(CertifiedPartTest, NothingWhereNotEvenBrakingIsCertified) {
  const double now_s = kStart_s + 4.0;  // at full speed
  const double here_x = ahead_.at(now_s).pose.position.x();
  OccupancyGrid grid = open_;
  fill_box(grid, {here_x + 0.7, -1.0}, {here_x + 1.2, 1.0});
  const LocalScene scene = scene_of(grid);
  EXPECT_FALSE(longest(ahead_, scene, now_s, now_s + 0.3, now_s + 4.0));
  // A second earlier there was time enough.
  EXPECT_TRUE(longest(ahead_, scene, now_s - 1.5, now_s - 1.2, now_s + 4.0));
}

TEST_F(CertifiedPartTest, ATurnInPlaceIsEndedInItsMidstAtOnceOnly) {
  const TurnPhase turn{{{0.0, 0.0}, -2.0}, 2.0, turn_duration_s(2.0, 1.5, 4.0)};
  const Motion motion(kStart_s,
                      {turn, straight_drive(0.0, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5).phases()[0]});
  const double middle_s = kStart_s + 0.5 * turn.duration_s;
  const double end_s = kStart_s + turn.duration_s;
  const LocalScene scene = scene_of(open_);
  const auto settled = longest(motion, scene, middle_s, middle_s + 0.1, middle_s + 0.2);
  ASSERT_TRUE(settled);
  EXPECT_NEAR(settled->motion.at(end_s).pose.yaw_rad, 0.0, 1e-4)
      << "the drive can follow from there";
  EXPECT_NEAR(settled->follows_until_s, end_s, 1e-6);
  const auto emergency = longest(motion, scene, middle_s, middle_s + 0.1, middle_s + 0.2, true);
  ASSERT_TRUE(emergency);
  EXPECT_LT(emergency->motion.end_time(), end_s);
  EXPECT_LT(emergency->motion.end_pose().yaw_rad, -0.1);
  for (const auto& promise : {settled, emergency}) EXPECT_LT(end(*promise).norm(), 1e-9);
}

TEST_F(CertifiedPartTest, ARobotThatStandsMayGoOnStanding) {
  const Motion stand = standing(kStart_s, {1.0, 0.0}, 0.0);
  const LocalScene scene = scene_of(open_);
  const auto promise = longest(stand, scene, kStart_s + 5.0, kStart_s + 5.3, kStart_s + 9.0);
  ASSERT_TRUE(promise);
  EXPECT_LT((end(*promise) - Vector2(1.0, 0.0)).norm(), 1e-9);
}

TEST_F(CertifiedPartTest, AManeuverThatDoesNotMeetWhatIsCommittedIsNone) {
  const LocalScene scene = scene_of(open_);
  const ManeuverStart start = start_of(ahead_, scene, kStart_s + 2.0);
  const Motion beside = straight_drive(kStart_s, {0.0, 0.05}, 0.0, 8.0, 0.9, 0.5);
  const auto part = [&](const Motion& motion, RequirementName required) {
    return certified_part(start, whole(motion, start.settled_s, false, ""), required);
  };
  for (const RequirementName required : {RequirementName::kPromise, RequirementName::kNone}) {
    EXPECT_FALSE(part(rest_of(beside, start.settled_s), required));
    EXPECT_TRUE(part(rest_of(ahead_, start.settled_s), required));
  }
}

TEST_F(CertifiedPartTest, AsTheLastResortNothingIsCertified) {
  OccupancyGrid grid = open_;
  const double now_s = kStart_s + 4.0;
  fill_box(grid, {ahead_.position(now_s).x() + 0.4, -1.0}, {12.0, 1.0});
  const LocalScene scene = scene_of(grid);
  const ManeuverStart start = start_of(ahead_, scene, now_s);
  const Motion stop(start.emergency_s,
                    brake_along(ahead_, start.emergency_s, robot_.hard_braking()));
  const Maneuver brakes = whole(stop, start.emergency_s, true, "brakes");
  EXPECT_FALSE(certified_part(start, brakes, RequirementName::kRenewal));
  EXPECT_TRUE(certified_part(start, brakes, RequirementName::kNone));
}

TEST_F(CertifiedPartTest, WhatIsPromisedTodayHoldsTomorrow) {
  LocalScene with_peer = scene_of(open_);
  with_peer.peers = {peer(standing(kStart_s - 9.0, {6.0, 0.4}, 0.0))};
  const auto promise = longest(ahead_, with_peer, kStart_s, kStart_s + 0.3, kStart_s + 60.0);
  ASSERT_TRUE(promise);
  for (double t = kStart_s; t < promise->motion.end_time() + 1.0; t += 0.1) {
    const Violation violation =
        violation_of(promise->motion, with_peer, RequirementName::kRenewal, t);
    EXPECT_FALSE(violation) << describe(violation);
  }
}

}  // namespace
}  // namespace mocha
