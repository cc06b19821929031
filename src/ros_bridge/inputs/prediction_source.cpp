#include "ros_bridge/inputs/prediction_source.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "ros_bridge/messages/prediction_conversions.h"
#include "ros_bridge/runtime/transport.h"

namespace mocha {
namespace {

constexpr std::size_t kMostPredicted = 1000;
constexpr double kFastest = 30.0;  // [m/s]
constexpr double kLargest_m = 20.0;
constexpr double kFarthest_m = 1e5;

void require(bool condition, std::uint32_t id, const char* what) {
  if (!condition) throw std::invalid_argument("obstacle " + std::to_string(id) + ": " + what);
}

}  // namespace

PredictedThing from_message(const mocha_ugv::PredictedObstacle& message) {
  const Vector2 place(message.position.x, message.position.y);
  const Vector2 velocity(message.velocity.x, message.velocity.y);
  require(place.allFinite() && place.cwiseAbs().maxCoeff() < kFarthest_m, message.id,
          "its place is not plausible");
  require(velocity.norm() < kFastest, message.id, "its velocity is not plausible");
  require(message.radius >= 0.0 && message.radius < kLargest_m, message.id,
          "its radius is not plausible");
  const Eigen::Matrix4d covariance =
      Eigen::Map<const Eigen::Matrix4d>(message.covariance.data()).transpose();
  const auto deviation = PredictedDeviation::of(covariance);
  require(deviation.place_m < kLargest_m && deviation.speed < kFastest, message.id,
          "its covariance is not plausible");
  return {message.id, place, velocity, message.radius, deviation};
}

NewestPredictions::NewestPredictions(std::string frame) : frame_(std::move(frame)) {}

double NewestPredictions::age_s(ros::Time now) const {
  return stamp_.isZero() ? std::numeric_limits<double>::infinity() : (now - stamp_).toSec();
}

void NewestPredictions::on_predictions(const mocha_ugv::PredictedObstacles& message) {
  try {
    if (message.header.frame_id != frame_)
      throw std::invalid_argument("the frame is not " + frame_);
    if (message.obstacles.size() + message.tentative.size() > kMostPredicted)
      throw std::invalid_argument("more than " + std::to_string(kMostPredicted) + " obstacles");
    Predictions newest{message.header.stamp.toSec(), {}, spread_from(message)};
    for (const auto* obstacles : {&message.obstacles, &message.tentative}) {
      for (const mocha_ugv::PredictedObstacle& obstacle : *obstacles) {
        const PredictedThing thing = from_message(obstacle);
        if (!obstacle.mapped) newest.things.push_back(thing);
      }
    }
    newest_ = std::move(newest);
    sensor_fault_ = message.fault;
    stamp_ = message.header.stamp;
  } catch (const std::exception& error) {
    ++refused_;
    refusal_ = error.what();
    ROS_WARN_THROTTLE(1.0, "Refused a message on predicted_obstacles: %s", error.what());
  }
}

PredictionSource::PredictionSource(ros::NodeHandle& node, std::string frame)
    : NewestPredictions(std::move(frame)),
      predictions_(node.subscribe("predicted_obstacles", 5, &NewestPredictions::on_predictions,
                                  static_cast<NewestPredictions*>(this), at_once())) {}

}  // namespace mocha
