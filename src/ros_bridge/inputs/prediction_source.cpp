#include "ros_bridge/inputs/prediction_source.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "ros_bridge/runtime/transport.h"
#include "world/prediction.h"

namespace mocha {
namespace {

constexpr std::size_t kMostObstacles = 1000;
constexpr double kFastest = 30.0;  // [m/s]
constexpr double kLargest_m = 20.0;
constexpr double kFarthest_m = 1e5;

void require(bool condition, std::uint32_t id, const char* what) {
  if (!condition) throw std::invalid_argument("obstacle " + std::to_string(id) + ": " + what);
}

}  // namespace

std::shared_ptr<const MovingObstacle> from_message(const mocha_ugv::PredictedObstacle& message,
                                                   ros::Time stamp,
                                                   const PredictionOptions& options) {
  const Vector2 place(message.position.x, message.position.y);
  const Vector2 velocity(message.velocity.x, message.velocity.y);
  require(place.cwiseAbs().maxCoeff() < kFarthest_m, message.id, "its place is not plausible");
  require(velocity.norm() < kFastest, message.id, "its velocity is not plausible");
  require(message.radius >= 0.0 && message.radius < kLargest_m, message.id,
          "its radius is not plausible");
  const Eigen::Matrix4d covariance =
      Eigen::Map<const Eigen::Matrix4d>(message.covariance.data()).transpose();
  const RadiusGrowth growth = growth_of(covariance, options.confidence);
  require(growth.radius_m < kLargest_m && growth.rate < kFastest, message.id,
          "its covariance is not plausible");
  return std::make_shared<PredictedDisc>(
      "moving thing " + std::to_string(message.id), stamp.toSec(), place, velocity,
      message.radius + growth.radius_m, growth.rate, options.growth_s);
}

NewestPredictions::NewestPredictions(std::string frame, const PredictionOptions& options)
    : frame_(std::move(frame)), options_(options) {}

double NewestPredictions::age_s(ros::Time now) const {
  return stamp_.isZero() ? std::numeric_limits<double>::infinity() : (now - stamp_).toSec();
}

void NewestPredictions::on_predictions(const mocha_ugv::PredictedObstacles& message) {
  try {
    if (message.header.frame_id != frame_)
      throw std::invalid_argument("the frame is not " + frame_);
    if (message.obstacles.size() > kMostObstacles)
      throw std::invalid_argument("more than " + std::to_string(kMostObstacles) + " obstacles");
    std::vector<std::shared_ptr<const MovingObstacle>> obstacles;
    std::vector<std::shared_ptr<const MovingObstacle>> expected;
    for (const auto& obstacle : message.obstacles) {
      obstacles.push_back(from_message(obstacle, message.header.stamp, options_));
      expected.push_back(from_message(obstacle, message.header.stamp, {0.0, 0.0}));
    }
    obstacles_ = std::move(obstacles);
    expected_ = std::move(expected);
    sensor_fault_ = message.fault;
    stamp_ = message.header.stamp;
  } catch (const std::exception& error) {
    ++refused_;
    refusal_ = error.what();
    ROS_WARN_THROTTLE(1.0, "Refused a message on predicted_obstacles: %s", error.what());
  }
}

PredictionSource::PredictionSource(ros::NodeHandle& node, std::string frame,
                                   const PredictionOptions& options)
    : NewestPredictions(std::move(frame), options),
      predictions_(node.subscribe("predicted_obstacles", 5, &NewestPredictions::on_predictions,
                                  static_cast<NewestPredictions*>(this), at_once())) {}

}  // namespace mocha
