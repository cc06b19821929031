#include "ros_bridge/inputs/prediction_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace mocha {
namespace {

mocha_ugv::PredictedObstacle walker(std::uint32_t id = 7) {
  mocha_ugv::PredictedObstacle message;
  message.id = id;
  message.position.x = 3.0;
  message.position.y = -1.0;
  message.velocity.x = -0.5;
  message.velocity.y = 0.25;
  message.radius = 0.3;
  for (int i = 0; i < 4; ++i) message.covariance[5 * i] = i < 2 ? 1e-4 : 4e-4;
  return message;
}

mocha_ugv::PredictedObstacles seen(std::vector<mocha_ugv::PredictedObstacle> obstacles,
                                   double stamp_s = 10.0, const std::string& frame = "map") {
  mocha_ugv::PredictedObstacles message;
  message.header.frame_id = frame;
  message.header.stamp = ros::Time(stamp_s);
  message.obstacles = std::move(obstacles);
  return message;
}

/// What makes a prediction unusable, one thing at a time.
std::vector<std::function<void(mocha_ugv::PredictedObstacle&)>> spoilers() {
  const double infinity = std::numeric_limits<double>::infinity();
  using Message = mocha_ugv::PredictedObstacle;
  std::vector<std::function<void(Message&)>> all;
  for (const double bad : {std::nan(""), infinity, -infinity, 1e300, -1e300}) {
    all.push_back([bad](Message& m) { m.position.x = bad; });
    all.push_back([bad](Message& m) { m.position.y = bad; });
    all.push_back([bad](Message& m) { m.velocity.x = bad; });
    all.push_back([bad](Message& m) { m.velocity.y = bad; });
    all.push_back([bad](Message& m) { m.radius = bad; });
    for (int i = 0; i < 16; ++i) all.push_back([bad, i](Message& m) { m.covariance[i] = bad; });
  }
  all.push_back([](Message& m) { m.radius = -0.01; });
  all.push_back([](Message& m) { m.radius = 20.1; });
  all.push_back([](Message& m) { m.position.y = 1.1e5; });
  all.push_back([](Message& m) { m.velocity.x = m.velocity.y = -22.0; });
  all.push_back([](Message& m) { m.covariance[0] = -1e-4; });
  all.push_back([](Message& m) { m.covariance[1] = m.covariance[4] = 2e-4; });    // more than both
  all.push_back([](Message& m) { m.covariance[2] = m.covariance[8] = 2.1e-4; });  // x with vx
  all.push_back([](Message& m) { m.covariance[0] = 500.0; });                     // anywhere
  all.push_back([](Message& m) { m.covariance[15] = 1000.0; });
  return all;
}

TEST(FromMessage, KeepsWhatIsSaid) {
  const PredictedThing thing = from_message(walker());
  EXPECT_EQ(thing.id, 7u);
  EXPECT_EQ(thing.place, Vector2(3.0, -1.0));
  EXPECT_EQ(thing.velocity, Vector2(-0.5, 0.25));
  EXPECT_EQ(thing.radius_m, 0.3);
  EXPECT_NEAR(thing.deviation.place_m, 0.01, 1e-9);
  EXPECT_NEAR(thing.deviation.speed, 0.02, 1e-9);
}

TEST(FromMessage, ReadsTheCovarianceRowByRow) {
  mocha_ugv::PredictedObstacle message = walker();
  message.covariance.assign(0.0);
  message.covariance[0] = 0.04;
  message.covariance[2] = message.covariance[8] = 0.01;  // x and vx
  message.covariance[10] = 0.01;
  EXPECT_NEAR(from_message(message).deviation.place_m, 0.2, 1e-9);
  EXPECT_NEAR(from_message(message).deviation.speed, 0.1, 1e-9);
}

TEST(FromMessage, RefusesWhatIsNotPlausibleAndSaysOfWhom) {
  int i = 0;
  for (const auto& spoil : spoilers()) {
    mocha_ugv::PredictedObstacle message = walker();
    spoil(message);
    EXPECT_THROW(from_message(message), std::invalid_argument) << i++;
  }
  mocha_ugv::PredictedObstacle message = walker(42);
  message.radius = -1.0;
  try {
    from_message(message);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("42"), std::string::npos) << error.what();
  }
}

struct NewestPredictionsTest : ::testing::Test {
  NewestPredictionsTest() { ros::Time::init(); }  // warnings are throttled

  void expect_the_first_holds(int refused) const {
    EXPECT_EQ(predictions.refused(), refused);
    EXPECT_FALSE(predictions.refusal().empty());
    ASSERT_EQ(predictions.newest().things.size(), 2u);
    EXPECT_EQ(predictions.newest().things[1].id, 2u);
    EXPECT_NEAR(predictions.age_s(ros::Time(11.5)), 1.5, 1e-6);
  }

  NewestPredictions predictions{"map"};
};

TEST_F(NewestPredictionsTest, WhatMayMoveIsKeptClearOfAndWhatTheMapHoldsIsLeftToIt) {
  mocha_ugv::PredictedObstacle mapped = walker();
  mapped.mapped = true;
  mocha_ugv::PredictedObstacle tentative = walker();
  tentative.id = 8;
  auto message = seen({mapped});
  message.tentative = {tentative};
  predictions.on_predictions(message);
  ASSERT_EQ(predictions.newest().things.size(), 1u);
  EXPECT_EQ(predictions.newest().things[0].id, 8u);
}

TEST_F(NewestPredictionsTest, HasNothingAtFirst) {
  EXPECT_TRUE(predictions.newest().things.empty());
  EXPECT_TRUE(std::isinf(predictions.age_s(ros::Time(1.0))));
  EXPECT_EQ(predictions.refused(), 0);
}

TEST_F(NewestPredictionsTest, TheNewestMessageIsWhatCounts) {
  predictions.on_predictions(seen({walker(1), walker(2)}));
  EXPECT_EQ(predictions.newest().things.size(), 2u);
  predictions.on_predictions(seen({walker(3)}, 11.0));
  ASSERT_EQ(predictions.newest().things.size(), 1u);
  EXPECT_EQ(predictions.newest().things[0].id, 3u);
  EXPECT_NEAR(predictions.age_s(ros::Time(11.5)), 0.5, 1e-6);
  predictions.on_predictions(seen({}, 12.0));  // that there is nothing is news, too
  EXPECT_TRUE(predictions.newest().things.empty());
  EXPECT_NEAR(predictions.age_s(ros::Time(12.0)), 0.0, 1e-6);
  EXPECT_EQ(predictions.refused(), 0);
}

TEST_F(NewestPredictionsTest, TellsWhichSensorLies) {
  auto message = seen({walker()});
  message.fault = "the scan is frozen";
  predictions.on_predictions(message);
  EXPECT_EQ(predictions.sensor_fault(), "the scan is frozen");
  predictions.on_predictions(seen({walker()}, 10.1));
  EXPECT_EQ(predictions.sensor_fault(), "");
}

TEST_F(NewestPredictionsTest, OneThatIsUnusableRefusesAll) {
  predictions.on_predictions(seen({walker(1), walker(2)}));
  int refused = 0;
  for (const auto& spoil : spoilers()) {
    auto message = seen({walker(3), walker(4), walker(5)}, 11.0);
    spoil(message.obstacles[refused % 3]);
    predictions.on_predictions(message);
    expect_the_first_holds(++refused);
  }
}

TEST_F(NewestPredictionsTest, ASpreadThatDoesNotFitRefusesAll) {
  predictions.on_predictions(seen({walker(1), walker(2)}));
  auto message = seen({walker(3)}, 11.0);
  message.confidences = {0.8};
  predictions.on_predictions(message);
  expect_the_first_holds(1);
  message.ahead = {1.0};
  message.deviations = {1.5};
  message.deviations_throughout = {2.5};
  predictions.on_predictions(message);
  EXPECT_EQ(predictions.newest().spread.deviations_throughout(1.0, 0.8), 2.5);
  EXPECT_EQ(predictions.newest().time_s, 11.0);
}

TEST_F(NewestPredictionsTest, AnotherFrameIsRefused) {
  predictions.on_predictions(seen({walker(1), walker(2)}));
  predictions.on_predictions(seen({walker(3)}, 11.0, "odom"));
  predictions.on_predictions(seen({}, 11.0, ""));
  expect_the_first_holds(2);
  EXPECT_NE(predictions.refusal().find("frame"), std::string::npos) << predictions.refusal();
}

TEST_F(NewestPredictionsTest, MoreThanCanBeIsRefused) {
  predictions.on_predictions(seen({walker(1), walker(2)}));
  predictions.on_predictions(seen(std::vector(10000, walker()), 11.0));
  predictions.on_predictions(seen(std::vector(1001, walker()), 11.0));
  expect_the_first_holds(2);
  predictions.on_predictions(seen(std::vector(1000, walker()), 11.0));
  EXPECT_EQ(predictions.newest().things.size(), 1000u);
  EXPECT_EQ(predictions.refused(), 2);
}

}  // namespace
}  // namespace mocha
