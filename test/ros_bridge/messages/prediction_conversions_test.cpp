#include "ros_bridge/messages/prediction_conversions.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

TEST(PredictionConversions, KeepEveryNumber) {
  TrackedObstacle obstacle{7,    12.5, {1.0, -2.0}, {0.5, 0.25}, 0.3, Eigen::Matrix4d::Random(),
                           false};
  const auto message = to_message({obstacle, obstacle}, "map", ros::Time(12.5));
  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_EQ(message.header.stamp, ros::Time(12.5));
  ASSERT_EQ(message.obstacles.size(), 2u);
  const auto& first = message.obstacles[0];
  EXPECT_EQ(first.id, 7u);
  EXPECT_EQ(first.position.x, 1.0);
  EXPECT_EQ(first.position.y, -2.0);
  EXPECT_EQ(first.velocity.x, 0.5);
  EXPECT_EQ(first.velocity.y, 0.25);
  EXPECT_EQ(first.radius, 0.3);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column)
      EXPECT_EQ(first.covariance[4 * row + column], obstacle.covariance(row, column));
  }
}

TEST(PredictionConversions, NothingIsAMessageToo) {
  EXPECT_TRUE(to_message({}, "map", ros::Time(1.0)).obstacles.empty());
}

}  // namespace
}  // namespace mocha
