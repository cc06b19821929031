#include "fleet/protocol/neighbourhood.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fleet/protocol/motions.h"
#include "fleet/protocol/network.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

constexpr double kNow_s = 20.0;
constexpr double kOurs_m = 5.0;
constexpr double kTheirs_m = 3.0;

CommittedTrajectory standing(const std::string& agent, const Vector2& place) {
  CommittedTrajectory trajectory;
  trajectory.agent = agent;
  trajectory.id = {1, 1};
  trajectory.state = TrajectoryState::kCommitted;
  trajectory.footprint_radius_m = 0.3;
  trajectory.braking = test::kRoverBraking;
  trajectory.motion = test::shared(test::stand(kNow_s - 1.0, place));
  return trajectory;
}

class NeighbourhoodTest : public ::testing::Test {
 protected:
  NeighbourhoodTest() {
    options_.reach = {30.0, 2.0, kOurs_m};
    options_.delta_dc_s = 0.0;
    binding_.bind(standing("m", Vector2::Zero()));
  }

  /// Its place was confirmed `age_s` ago.
  static Peer peer_at(double distance_m, double age_s = 0.0) {
    Peer peer;
    peer.promise_reach_m = kTheirs_m;
    peer.binding.bind(standing("p", {distance_m, 0.0}));
    peer.placed_s = kNow_s - age_s;
    return peer;
  }

  Neighbourhood here() const { return {options_, binding_, kNow_s}; }

  CommitmentOptions options_ = test::options("m");
  ReservationChain binding_;
  /// Both promise as far as they may, toward each other.
  const double near_m_ = kOurs_m + kTheirs_m + 0.6 + options_.peer_clearance_m;
};

TEST_F(NeighbourhoodTest, NearIsWhosePromisesCanMeetOurs) {
  EXPECT_TRUE(here().is_near(peer_at(near_m_ - 0.01)));
  EXPECT_FALSE(here().is_near(peer_at(near_m_ + 0.01)));
}

TEST_F(NeighbourhoodTest, BothMayHaveLeftWhatTheyPromisedSinceThePlaceWasConfirmed) {
  EXPECT_TRUE(here().is_near(peer_at(near_m_ + 1.9, 0.5)));
  EXPECT_FALSE(here().is_near(peer_at(near_m_ + 2.1, 0.5)));
  EXPECT_TRUE(here().is_near(peer_at(near_m_ + 2.1, 0.5), 0.1));
  options_.delta_dc_s = 0.1;  // a confirmation is as old as it was on its way
  EXPECT_TRUE(here().is_near(peer_at(near_m_ + 2.1, 0.5)));
}

TEST_F(NeighbourhoodTest, WhosePlaceIsNotKnownIsNear) {
  EXPECT_TRUE(here().is_near(Peer()));
  EXPECT_TRUE(here().is_near(peer_at(1000.0, options_.reach_timeout_s + 0.01)));
  binding_ = ReservationChain();
  EXPECT_TRUE(here().is_near(peer_at(1000.0)));
}

TEST_F(NeighbourhoodTest, OfAnUnknownClockThePeerMayBeAnywhereOnItsWay) {
  Peer peer = peer_at(0.0);
  CommittedTrajectory comes = standing("p", Vector2::Zero());
  comes.id.sequence = 2;
  comes.motion =
      test::shared(test::drive(kNow_s, {{near_m_ + 6.0, 0.0}, {near_m_ - 0.5, 0.0}}, 1.0));
  peer.binding = ReservationChain();
  peer.binding.bind(comes);
  EXPECT_TRUE(here().is_near(peer));
  const double stamp_s = kNow_s;  // our clocks agree
  peer.clock.add(kNow_s - 0.01, 0.0, stamp_s, 0.0, kNow_s);
  EXPECT_FALSE(here().is_near(peer));
}

TEST_F(NeighbourhoodTest, UrgencyFallsWithTheDistanceSquared) {
  EXPECT_EQ(here().urgency(peer_at(1.0)), 1.0);
  EXPECT_NEAR(here().urgency(peer_at(3.0 * near_m_)), 1.0 / 9.0, 1e-9);
}

}  // namespace
}  // namespace mocha
