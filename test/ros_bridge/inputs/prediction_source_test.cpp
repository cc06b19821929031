#include "ros_bridge/inputs/prediction_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace mocha {
namespace {

constexpr PredictionOptions kOptions{0.8, 2.0};

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
  all.push_back([](Message& m) { m.covariance[15] = 500.0; });
  return all;
}

TEST(FromMessage, IsADiscThatHoldsTheThing) {
  const auto disc = from_message(walker(), ros::Time(12.5), kOptions);
  EXPECT_EQ(disc->name(), "moving thing 7");
  const double deviations = std::sqrt(-2.0 * std::log(0.2));
  const auto now = disc->at(12.5);
  EXPECT_EQ(now.centre, Vector2(3.0, -1.0));
  EXPECT_EQ(now.velocity, Vector2(-0.5, 0.25));
  EXPECT_NEAR(now.radius_m, 0.3 + 0.01 * deviations, 1e-9);
  const auto later = disc->at(14.5);
  EXPECT_LT((later.centre - Vector2(2.0, -0.5)).norm(), 1e-6);
  EXPECT_NEAR(later.radius_m, 0.3 + 0.05 * deviations, 1e-6);
  EXPECT_NEAR(disc->at(30.0).radius_m, later.radius_m, 1e-9);  // grows for two seconds only
}

TEST(FromMessage, ReadsTheCovarianceRowByRow) {
  mocha_ugv::PredictedObstacle message = walker();
  message.covariance.assign(0.0);
  message.covariance[0] = 0.04;
  message.covariance[2] = message.covariance[8] = 0.01;  // x and vx
  message.covariance[10] = 0.01;
  const double deviations = std::sqrt(-2.0 * std::log(0.2));
  const auto disc = from_message(message, ros::Time(12.5), kOptions);
  EXPECT_NEAR(disc->at(12.5).radius_m, 0.3 + 0.2 * deviations, 1e-9);
  EXPECT_NEAR(disc->at(12.5).radius_rate, 0.1 * deviations, 1e-9);
}

TEST(FromMessage, RefusesWhatIsNotPlausibleAndSaysOfWhom) {
  int i = 0;
  for (const auto& spoil : spoilers()) {
    mocha_ugv::PredictedObstacle message = walker();
    spoil(message);
    EXPECT_THROW(from_message(message, ros::Time(1.0), kOptions), std::invalid_argument) << i++;
  }
  mocha_ugv::PredictedObstacle message = walker(42);
  message.radius = -1.0;
  try {
    from_message(message, ros::Time(1.0), kOptions);
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
    ASSERT_EQ(predictions.obstacles().size(), 2u);
    EXPECT_EQ(predictions.obstacles()[1]->name(), "moving thing 2");
    EXPECT_NEAR(predictions.age_s(ros::Time(11.5)), 1.5, 1e-6);
  }

  NewestPredictions predictions{"map", kOptions};
};

TEST_F(NewestPredictionsTest, HasNothingAtFirst) {
  EXPECT_TRUE(predictions.obstacles().empty());
  EXPECT_TRUE(std::isinf(predictions.age_s(ros::Time(1.0))));
  EXPECT_EQ(predictions.refused(), 0);
}

TEST_F(NewestPredictionsTest, TheNewestMessageIsWhatCounts) {
  predictions.on_predictions(seen({walker(1), walker(2)}));
  EXPECT_EQ(predictions.obstacles().size(), 2u);
  predictions.on_predictions(seen({walker(3)}, 11.0));
  ASSERT_EQ(predictions.obstacles().size(), 1u);
  EXPECT_EQ(predictions.obstacles()[0]->name(), "moving thing 3");
  EXPECT_NEAR(predictions.age_s(ros::Time(11.5)), 0.5, 1e-6);
  predictions.on_predictions(seen({}, 12.0));  // that there is nothing is news, too
  EXPECT_TRUE(predictions.obstacles().empty());
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
  EXPECT_EQ(predictions.obstacles().size(), 1000u);
  EXPECT_EQ(predictions.refused(), 2);
}

}  // namespace
}  // namespace mocha
