#include "ros_bridge/messages/prediction_conversions.h"

namespace mocha {
namespace {

mocha_ugv::PredictedObstacle to_message(const TrackedObstacle& obstacle) {
  mocha_ugv::PredictedObstacle message;
  message.id = obstacle.id;
  message.position.x = obstacle.position.x();
  message.position.y = obstacle.position.y();
  message.velocity.x = obstacle.velocity.x();
  message.velocity.y = obstacle.velocity.y();
  message.radius = obstacle.radius_m;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column)
      message.covariance[4 * row + column] = obstacle.covariance(row, column);
  }
  return message;
}

}  // namespace

mocha_ugv::PredictedObstacles to_message(const std::vector<TrackedObstacle>& obstacles,
                                         const std::string& frame, ros::Time stamp) {
  mocha_ugv::PredictedObstacles message;
  message.header.stamp = stamp;
  message.header.frame_id = frame;
  for (const TrackedObstacle& obstacle : obstacles)
    message.obstacles.push_back(to_message(obstacle));
  return message;
}

}  // namespace mocha
