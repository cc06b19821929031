#include "planning/candidates/warm_start.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"
#include "trajectory/minco.h"

namespace mocha {
namespace {

/// A drive of five pieces on a bend, and the phases about it.
class WarmStartTest : public ::testing::Test {
 protected:
  WarmStartTest() {
    Eigen::Matrix2Xd knots(2, 4);
    knots << 1.0, 2.0, 3.0, 4.0, 0.2, 0.5, 0.5, 0.2;
    Eigen::VectorXd durations_s(5);
    durations_s << 1.5, 1.0, 1.0, 1.0, 1.5;
    PlanarMinco::State start = PlanarMinco::State::Zero();
    PlanarMinco::State end = PlanarMinco::State::Zero();
    start.col(2) = Vector2(0.4, 0.08);
    end.col(0) = Vector2(5.0, 0.0);
    end.col(2) = Vector2(-0.4, 0.08);
    PlanarMinco minco;
    minco.resize(5);
    minco.solve(start, end, knots, durations_s);
    path_ = minco.curve();
    motion_ = Motion(kStart_s, {StandPhase{{{0.0, 0.0}, heading_rad_}, 2.0}, DrivePhase{1, path_}});
  }

  std::optional<InitialKnots<2>> left(double from_s) const {
    return remaining_knots(motion_, from_s, path_.state(std::max(0.0, from_s - kStart_s - 2.0)),
                           {5.0, 0.0});
  }

  static constexpr double kStart_s = 100.0;
  double heading_rad_ = std::atan2(0.08, 0.4);
  PlanarPath path_;
  Motion motion_;
};

TEST_F(WarmStartTest, BeforeTheDriveAllOfItIsLeft) {
  const auto knots = left(kStart_s);
  ASSERT_TRUE(knots);
  ASSERT_EQ(knots->durations_s.size(), 5);
  EXPECT_NEAR(knots->durations_s.sum(), path_.duration(), 1e-9);
  EXPECT_LT((knots->path.col(2) - Vector2(2.0, 0.5)).norm(), 1e-9);
}

TEST_F(WarmStartTest, UnderWayThePiecesThatFollowAreLeftAndAPartOfTheOneThatIsDriven) {
  const auto knots = left(kStart_s + 2.0 + 1.7);
  ASSERT_TRUE(knots);
  ASSERT_EQ(knots->durations_s.size(), 4);
  EXPECT_NEAR(knots->durations_s[0], 0.8, 1e-9);
  EXPECT_LT((knots->path.col(1) - Vector2(2.0, 0.5)).norm(), 1e-9);
}

TEST_F(WarmStartTest, WhatIsLeftOfAPieceIsJoinedToTheNextWhereItIsShort) {
  const auto knots = left(kStart_s + 2.0 + 2.3);
  ASSERT_TRUE(knots);
  ASSERT_EQ(knots->durations_s.size(), 3);
  EXPECT_NEAR(knots->durations_s[0], 1.2, 1e-9);
  EXPECT_LT((knots->path.col(1) - Vector2(3.0, 0.5)).norm(), 1e-9);
}

TEST_F(WarmStartTest, NothingIsLeftAtTheEnd) {
  EXPECT_FALSE(left(motion_.end_time() - 0.05));
  EXPECT_FALSE(left(motion_.end_time() + 1.0));
  EXPECT_FALSE(remaining_knots(Motion(), kStart_s, path_.state(0.0), {5.0, 0.0}));
}

TEST_F(WarmStartTest, DoesNotServeFromElsewhereOrToElsewhereOrAtAnotherSpeed) {
  const double from_s = kStart_s + 4.0;
  PlanarMinco::State start = path_.state(2.0);
  ASSERT_TRUE(remaining_knots(motion_, from_s, start, {5.0, 0.0}));
  EXPECT_FALSE(remaining_knots(motion_, from_s, start, {5.0, 0.3}));
  start(1, 0) += 0.2;
  EXPECT_FALSE(remaining_knots(motion_, from_s, start, {5.0, 0.0}));
  start = path_.state(2.0);
  start.col(1) *= 0.5;
  EXPECT_FALSE(remaining_knots(motion_, from_s, start, {5.0, 0.0}));
}

}  // namespace
}  // namespace mocha
