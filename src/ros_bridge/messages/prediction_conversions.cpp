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
  message.mapped = obstacle.is_mapped;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column)
      message.covariance[4 * row + column] = obstacle.covariance(row, column);
  }
  return message;
}

using Table = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::vector<double> row_by_row(const Eigen::MatrixXd& table) {
  const Table rows = table;
  return {rows.data(), rows.data() + rows.size()};
}

/// Empty where the sizes do not match.
Eigen::MatrixXd table(const std::vector<double>& values, std::size_t rows, std::size_t columns) {
  if (columns == 0 || values.size() % columns != 0 || values.size() / columns != rows) return {};
  return Eigen::Map<const Table>(values.data(), static_cast<Eigen::Index>(rows),
                                 static_cast<Eigen::Index>(columns));
}

}  // namespace

mocha_ugv::PredictedObstacles to_message(const std::vector<TrackedObstacle>& obstacles,
                                         const PredictionSpread& spread, const std::string& frame,
                                         ros::Time stamp) {
  mocha_ugv::PredictedObstacles message;
  message.header.stamp = stamp;
  message.header.frame_id = frame;
  for (const TrackedObstacle& obstacle : obstacles)
    (obstacle.is_mover ? message.obstacles : message.tentative).push_back(to_message(obstacle));
  message.ahead = spread.ahead_s;
  message.confidences = spread.confidences;
  message.deviations = row_by_row(spread.at);
  message.deviations_throughout = row_by_row(spread.throughout);
  return message;
}

PredictionSpread spread_from(const mocha_ugv::PredictedObstacles& message) {
  if (message.ahead.empty() && message.confidences.empty() && message.deviations.empty() &&
      message.deviations_throughout.empty())
    return PredictionSpread::normal();
  const std::size_t rows = message.ahead.size();
  const std::size_t columns = message.confidences.size();
  PredictionSpread spread{message.ahead, message.confidences,
                          table(message.deviations, rows, columns),
                          table(message.deviations_throughout, rows, columns)};
  spread.check();
  return spread;
}

}  // namespace mocha
