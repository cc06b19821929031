#include "ros_bridge/messages/prediction_conversions.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mocha {
namespace {

TrackedObstacle mover(std::uint32_t id) {
  return {id,   12.5,  {1.0, -2.0}, {0.5, 0.25}, 0.3,        Eigen::Matrix4d::Random(),
          true, false, false,       true,        {1.0, -2.0}};
}

TEST(PredictionConversions, KeepEveryNumber) {
  const TrackedObstacle obstacle = mover(7);
  const auto message =
      to_message({obstacle, obstacle}, PredictionSpread::normal(), "map", ros::Time(12.5));
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

TEST(PredictionConversions, WhatMayMoveIsTentativeAndWhatTheMapHoldsIsSaidToBe) {
  TrackedObstacle tentative = mover(1);
  tentative.is_mover = false;
  TrackedObstacle mapped = mover(2);
  mapped.is_mapped = true;
  const auto message =
      to_message({tentative, mapped, mover(3)}, PredictionSpread::normal(), "map", ros::Time(12.5));
  ASSERT_EQ(message.tentative.size(), 1u);
  EXPECT_EQ(message.tentative[0].id, 1u);
  ASSERT_EQ(message.obstacles.size(), 2u);
  EXPECT_TRUE(message.obstacles[0].mapped);
  EXPECT_FALSE(message.obstacles[1].mapped);
}

TEST(PredictionConversions, NothingIsAMessageToo) {
  EXPECT_TRUE(to_message({}, PredictionSpread::normal(), "map", ros::Time(1.0)).obstacles.empty());
}

PredictionSpread known_spread() {
  PredictionSpread spread{{0.5, 1.0}, {0.5, 0.8, 0.9}, Eigen::MatrixXd(2, 3), {}};
  spread.at << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;
  spread.throughout = 2.0 * spread.at;
  return spread;
}

TEST(PredictionConversions, TheSpreadComesBackAsItWent) {
  const PredictionSpread spread = known_spread();
  const PredictionSpread back = spread_from(to_message({}, spread, "map", ros::Time(1.0)));
  EXPECT_EQ(back.ahead_s, spread.ahead_s);
  EXPECT_EQ(back.confidences, spread.confidences);
  EXPECT_EQ(back.at, spread.at);
  EXPECT_EQ(back.throughout, spread.throughout);
}

TEST(PredictionConversions, WithoutSpreadErrorsAreTakenForNormal) {
  EXPECT_EQ(spread_from({}).at, PredictionSpread::normal().at);
}

TEST(PredictionConversions, ASpreadThatDoesNotFitIsRefused) {
  const auto good = to_message({}, known_spread(), "map", ros::Time(1.0));
  std::vector<mocha_ugv::PredictedObstacles> bad(6, good);
  bad[0].deviations.pop_back();
  bad[1].deviations_throughout.clear();
  bad[2].ahead.clear();
  bad[3].confidences.clear();
  bad[4].deviations[4] = std::nan("");
  bad[5].confidences.push_back(0.95);
  for (std::size_t i = 0; i < bad.size(); ++i)
    EXPECT_THROW(spread_from(bad[i]), std::invalid_argument) << i;
}

}  // namespace
}  // namespace mocha
