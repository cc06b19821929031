#include "ros_bridge/messages/simulation_messages.h"

#include <gtest/gtest.h>

#include <utility>

namespace mocha {
namespace {

TEST(ContactMessage, SaysWhoTouchedWhatHowFastAndWhoseItIs) {
  using mocha_ugv::Contact;
  const Touch touch{{1.0, -2.0}, {0.3, 0.4}, {-0.6, 0.0}, {1.0, 0.0}};
  for (const auto& [blame, expected] : {std::pair(Blame::kOwn, Contact::OWN + 0),
                                        {Blame::kStanding, Contact::STANDING + 0},
                                        {Blame::kUnseen, Contact::UNSEEN + 0}}) {
    const Contact message = contact_message({"ugv1", "moving", 0.05, touch, blame}, ros::Time(7.5));
    EXPECT_EQ(message.header.stamp, ros::Time(7.5));
    EXPECT_EQ(message.header.frame_id, "map");
    EXPECT_EQ(message.robot, "ugv1");
    EXPECT_EQ(message.other, "moving");
    EXPECT_EQ(message.place.x, 1.0);
    EXPECT_EQ(message.place.y, -2.0);
    EXPECT_EQ(message.depth, 0.05);
    EXPECT_EQ(message.blame, expected);
    EXPECT_NEAR(message.robot_speed, 0.5, 1e-12);
    EXPECT_NEAR(message.approach_speed, 0.9, 1e-12);
  }
}

}  // namespace
}  // namespace mocha
