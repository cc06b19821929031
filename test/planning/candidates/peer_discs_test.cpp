#include "planning/candidates/peer_discs.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"
#include "safety/certificate.h"
#include "safety/requirement.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

constexpr double kRadius_m = 0.25;

PeerObstacle peer(Motion motion) {
  return {"ugv2", std::make_shared<const Motion>(std::move(motion)), kRadius_m,
          test::kRoverBraking};
}

TEST(PeerDiscs, WhoIsAboutToRestStands) {
  const Motion drive = straight_drive(0.0, {0.0, 0.0}, 0.0, 2.0, 0.5, 0.5);
  const PeerObstacle moving = peer(drive);
  EXPECT_FALSE(stands(moving, 0.0));
  EXPECT_FALSE(stands(moving, drive.end_time() - 0.6));
  EXPECT_TRUE(stands(moving, drive.end_time() - 0.4));
  EXPECT_TRUE(stands(peer(standing(0.0, {1.0, 0.0}, 0.0)), 5.0));
}

TEST(PeerDiscs, AtTheEdgeOfTheDiscTheRobotIsJustApart) {
  const RobotModel robot = rover();
  const PeerObstacle other = peer(standing(0.0, {1.0, 2.0}, 0.0));
  const BlockedDisc disc = peer_keep_out(other, 3.0, robot, 0.0);
  EXPECT_EQ(disc.centre, Vector2(1.0, 2.0));
  EXPECT_NEAR(disc.radius_m, kRadius_m + distance_to_peers_m(robot), 1e-12);
  EXPECT_GT(disc.radius_m, kRadius_m + robot.footprint.circumscribed_radius_m());
  EXPECT_NEAR(peer_keep_out(other, 3.0, robot, 0.1).radius_m, disc.radius_m + 0.1, 1e-12);
}

}  // namespace
}  // namespace mocha
