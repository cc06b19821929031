#pragma once

#include <mocha_ugv/PredictedObstacles.h>
#include <ros/node_handle.h>

#include <string>

#include "world/moving/prediction.h"

namespace mocha {

/// Throws std::invalid_argument for values that are not finite or not plausible (faster than 30
/// m/s, larger than 20 m, farther than 100 km, uncertain by more than 20 m or 30 m/s).
PredictedThing from_message(const mocha_ugv::PredictedObstacle& message);

/// The newest of the messages about what moves around the robot.
class NewestPredictions {
 public:
  /// A message in another frame than `frame`, with more than a thousand obstacles, or with one that
  /// from_message() refuses, is refused as a whole and counted: what is left out could be what the
  /// robot runs into, so the former message holds until it is too old.
  explicit NewestPredictions(std::string frame);

  void on_predictions(const mocha_ugv::PredictedObstacles& message);

  const Predictions& newest() const { return newest_; }
  /// Which sensor lies, by the newest message; empty: none.
  const std::string& sensor_fault() const { return sensor_fault_; }
  /// Since the stamp of the newest message [s]; infinity before the first.
  double age_s(ros::Time now) const;
  int refused() const { return refused_; }
  const std::string& refusal() const { return refusal_; }  ///< why, the last time

 private:
  const std::string frame_;
  Predictions newest_;
  std::string sensor_fault_;
  ros::Time stamp_;
  int refused_ = 0;
  std::string refusal_;
};

/// The newest predictions for this node's robot, from `predicted_obstacles`.
class PredictionSource : public NewestPredictions {
 public:
  PredictionSource(ros::NodeHandle& node, std::string frame);

 private:
  ros::Subscriber predictions_;
};

}  // namespace mocha
