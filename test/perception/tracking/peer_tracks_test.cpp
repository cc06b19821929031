#include "perception/tracking/peer_tracks.h"

#include <gtest/gtest.h>

#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

PeerMotion standing(const Vector2& at, double start_s, std::uint32_t sequence,
                    const std::string& name = "ugv2") {
  return {name,
          {1, sequence},
          std::make_shared<Motion>(start_s, std::vector<Phase>{StandPhase{{at, 0.0}, 5.0}}),
          0.3,
          test::kRoverBraking};
}

std::vector<Beam> hit(const Vector2& at, double t) {
  return {{{0.0, 0.0, 0.2}, {at.x(), at.y(), 0.2}, BeamEnd::kHit, t}};
}

TEST(PeerTracks, HitsOnAPeerAreIgnoredWithinTheMargin) {
  PeerTracks peers(0.1, 1.0);
  peers.update(10.0, {standing({2.0, 0.0}, 9.0, 1)});
  auto near = hit({1.61, 0.0}, 10.2);
  EXPECT_EQ(peers.ignore_peers(near), 1);
  EXPECT_EQ(near.front().kind, BeamEnd::kIgnored);
  auto off = hit({1.59, 0.0}, 10.2);
  EXPECT_EQ(peers.ignore_peers(off), 0);
  EXPECT_EQ(off.front().kind, BeamEnd::kHit);
  auto miss = near;
  miss.front().kind = BeamEnd::kMiss;
  EXPECT_EQ(peers.ignore_peers(miss), 0);
}

TEST(PeerTracks, APeerStaysWhereItIsUntilAMotionThatDoesNotJoinBegins) {
  PeerTracks peers(0.1, 1.0);
  const std::vector<PeerMotion> both = {standing({2.0, 0.0}, 9.0, 1),
                                        standing({5.0, 0.0}, 10.3, 2)};
  for (const double stamp_s : {10.0, 10.1}) {
    peers.update(stamp_s, both);
    ASSERT_EQ(peers.at(10.2).size(), 1u);
    EXPECT_EQ(peers.at(10.2)[0].centre, Vector2(2.0, 0.0));
    EXPECT_EQ(peers.at(10.4)[0].centre, Vector2(5.0, 0.0));
  }
}

TEST(PeerTracks, AStalePromiseHidesNothing) {
  PeerTracks peers(0.1, 1.0);
  peers.update(10.0, {standing({2.0, 0.0}, 9.0, 1)});
  auto late = hit({1.9, 0.0}, 11.1);
  EXPECT_EQ(peers.ignore_peers(late), 0);
}

TEST(PeerTracks, AMotionThatHasNotBegunDoesNotMoveThePeer) {
  PeerTracks peers(0.1, 1.0);
  peers.update(10.0, {standing({2.0, 0.0}, 9.0, 1)});
  peers.update(10.1, {standing({4.0, 0.0}, 10.5, 2)});
  EXPECT_EQ(peers.at(10.4).front().centre, Vector2(2.0, 0.0));
  EXPECT_EQ(peers.at(10.6).front().centre, Vector2(4.0, 0.0));
  peers.update(10.7, {standing({4.0, 0.0}, 10.5, 2)});
  EXPECT_EQ(peers.at(10.4).front().centre, Vector2(2.0, 0.0)) << "scans may wait for transforms";
}

TEST(PeerTracks, AnEmergencyOvertakesAMotionThatHasNotBegun) {
  PeerTracks peers(0.1, 1.0);
  peers.update(10.0, {standing({2.0, 0.0}, 9.0, 1)});
  peers.update(10.1, {standing({4.0, 0.0}, 10.5, 2)});
  peers.update(10.2, {standing({3.0, 0.0}, 10.2, 3)});
  EXPECT_EQ(peers.at(10.8).front().centre, Vector2(3.0, 0.0));
}

TEST(PeerTracks, AbsentPeersAreForgotten) {
  PeerTracks peers(0.1, 1.0);
  peers.update(10.0, {standing({2.0, 0.0}, 9.0, 1), standing({5.0, 0.0}, 9.0, 1, "ugv3")});
  EXPECT_EQ(peers.at(10.0).size(), 2u);
  peers.update(10.1, {standing({5.0, 0.0}, 9.0, 1, "ugv3")});
  ASSERT_EQ(peers.at(10.1).size(), 1u);
  EXPECT_EQ(peers.at(10.1).front().centre, Vector2(5.0, 0.0));
}

TEST(PeerTracks, RefusesBadParameters) {
  EXPECT_THROW(PeerTracks(-0.1, 1.0), std::invalid_argument);
  EXPECT_THROW(PeerTracks(0.1, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace mocha
