#include "ros_bridge/messages/emergency_stop_conversions.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace mocha {
namespace {

const ros::Time kStamp(1700000000, 250000000);

TEST(EmergencyStopConversions, GiveBackWhatTheFleetIsTold) {
  const FleetStops sent{"ugv1", 3, {{"ugv2", 7, 6, kStamp.toSec(), "told by /joystick"}}};
  const FleetStops heard = stops_from_message(to_message(sent, kStamp));
  EXPECT_EQ(heard.agent, "ugv1");
  EXPECT_EQ(heard.epoch, 3U);
  ASSERT_EQ(heard.stops.size(), 1U);
  EXPECT_EQ(heard.stops[0].agent, "ugv2");
  EXPECT_EQ(heard.stops[0].ordered, 7U);
  EXPECT_EQ(heard.stops[0].released, 6U);
  EXPECT_NEAR(heard.stops[0].since_s, kStamp.toSec(), 1e-6);
  EXPECT_EQ(heard.stops[0].reason, "told by /joystick");
}

TEST(EmergencyStopConversions, RefuseWhatNoRobotCanHaveMeant) {
  auto message = to_message(FleetStops{"ugv1", 3, {{"ugv2", 7, 6, 1.0, ""}}}, kStamp);
  message.stops[0].released = 8;
  EXPECT_THROW(stops_from_message(message), std::invalid_argument);
  message.stops[0].released = 6;
  message.stops[0].reason = "\xff";
  EXPECT_THROW(stops_from_message(message), std::invalid_argument);
}

TEST(EmergencyStopConversions, TheStateSaysWhoSinceWhenAndHowToReset) {
  EmergencyStop stop("ugv1", 1, {});
  EXPECT_EQ(state_of(stop, "ugv1", kStamp).message, "no emergency stop");
  EXPECT_FALSE(state_of(stop, "ugv1", kStamp).stopped);

  stop.stop_robot(kStamp.toSec(), "told by /joystick");
  auto state = state_of(stop, "ugv1", kStamp);
  EXPECT_TRUE(state.stopped && state.robot && !state.fleet);
  EXPECT_EQ(state.by, std::vector<std::string>{"ugv1"});
  EXPECT_EQ(
      state.message,
      "emergency stop of ugv1 since 2023-Nov-14 22:13:20.250000 UTC: told by /joystick; to reset "
      "it: rosservice call /emergency_stop false");

  stop.receive({"ugv2", 1, {{"ugv2", 1, 0, kStamp.toSec(), "called by /rviz"}}}, 0.0);
  state = state_of(stop, "ugv1", kStamp);
  EXPECT_TRUE(state.stopped && state.robot && state.fleet);
  EXPECT_EQ(state.by, (std::vector<std::string>{"ugv1", "ugv2"}));
  EXPECT_NE(state.message.find(". emergency stop of the fleet by ugv2 since 2023"),
            std::string::npos);
  EXPECT_NE(state.message.find("rosservice call /fleet/emergency_stop false"), std::string::npos);

  const auto resets = state.resets;
  stop.reset_robot();
  stop.reset_fleet(1.0);
  state = state_of(stop, "ugv1", kStamp);
  EXPECT_FALSE(state.stopped);
  EXPECT_EQ(state.resets, resets + 2);
}

TEST(EmergencyStopConversions, ATimeThatRosDoesNotHaveIsNoProblem) {
  for (const double time_s : {-1.0, 1e300}) {
    const FleetStops sent{"ugv1", 3, {{"ugv2", 7, 6, time_s, ""}}};
    EXPECT_TRUE(to_message(sent, kStamp).stops[0].since.isZero());
    EmergencyStop stop("ugv1", 1, {});
    stop.receive({"ugv2", 3, sent.stops}, 0.0);
    EXPECT_NO_THROW(state_of(stop, "ugv1", kStamp));
  }
}

}  // namespace
}  // namespace mocha
