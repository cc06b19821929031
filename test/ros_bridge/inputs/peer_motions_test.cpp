#include "ros_bridge/inputs/peer_motions.h"

#include <gtest/gtest.h>

#include <limits>

#include "fleet/protocol/motions.h"
#include "ros_bridge/messages/committed_trajectory_conversions.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

mocha_ugv::Trajectory trajectory(const std::string& agent, std::uint32_t sequence = 1) {
  CommittedTrajectory promise;
  promise.agent = agent;
  promise.id = {4, sequence};
  promise.state = TrajectoryState::kCommitted;
  promise.footprint_radius_m = 0.3;
  promise.braking = test::kRoverBraking;
  promise.motion = test::shared(test::drive(12.0, {{0.0, 0.0}, {2.0, 0.0}}, 1.0));
  return to_message(promise, "map", ros::Time(12.0));
}

mocha_ugv::FleetTrajectories fleet(std::vector<mocha_ugv::Trajectory> trajectories) {
  mocha_ugv::FleetTrajectories message;
  message.header.frame_id = "map";
  message.mistimed.assign(trajectories.size(), 0.1);
  message.trajectories = std::move(trajectories);
  return message;
}

TEST(PeerMotions, AreThoseOfAllOthers) {
  const auto reading = peers_of(
      fleet({trajectory("ugv1"), trajectory("ugv2"), trajectory("ugv2", 2)}), "ugv1", "map");
  ASSERT_EQ(reading.motions.size(), 2u);
  EXPECT_EQ(reading.motions[0].name, "ugv2");
  EXPECT_EQ(reading.motions[1].id, std::make_pair(4u, 2u));
  EXPECT_EQ(reading.motions[1].radius_m, 0.3);
  EXPECT_EQ(reading.motions[1].mistimed_s, 0.1);
  EXPECT_EQ(reading.motions[1].braking.deceleration(), test::kRoverBraking.deceleration());
  EXPECT_EQ(reading.motions[1].braking.max_acceleration(), test::kRoverBraking.max_acceleration());
  EXPECT_EQ(reading.motions[1].motion->start_time(), 12.0);
  EXPECT_TRUE(reading.refused.empty());
}

TEST(PeerMotions, WhatIsNotValidIsRefusedAloneAndByName) {
  const auto refused = [&](auto change) {
    auto bad = trajectory("ugv3");
    change(bad);
    const auto reading = peers_of(fleet({bad, trajectory("ugv2")}), "ugv1", "map");
    ASSERT_EQ(reading.motions.size(), 1u);
    EXPECT_EQ(reading.motions[0].name, "ugv2");
    EXPECT_EQ(reading.refused, std::set<std::string>{bad.agent});
    EXPECT_FALSE(reading.why.empty());
  };
  refused([](auto& m) { m.agent.clear(); });
  refused([](auto& m) { m.state = mocha_ugv::Trajectory::PROPOSED; });
  refused([](auto& m) { m.state = mocha_ugv::Trajectory::PLANNED; });
  refused([](auto& m) { m.footprint_radius = 0.0; });
  refused([](auto& m) { m.footprint_radius = 100.0; });
  refused([](auto& m) { m.footprint_radius = std::numeric_limits<double>::quiet_NaN(); });
  refused([](auto& m) { m.deceleration = 0.0; });
  refused([](auto& m) { m.deceleration = 60.0; });
  refused([](auto& m) { m.max_acceleration = std::numeric_limits<double>::quiet_NaN(); });
  refused([](auto& m) { m.phases.clear(); });
  refused([](auto& m) { m.phases[0].x[1] = std::numeric_limits<double>::quiet_NaN(); });
}

TEST(PeerMotions, AMessageInAnotherFrameIsNone) {
  auto message = fleet({trajectory("ugv2")});
  message.header.frame_id = "odom";
  EXPECT_THROW(peers_of(message, "ugv1", "map"), std::invalid_argument);
}

}  // namespace
}  // namespace mocha
