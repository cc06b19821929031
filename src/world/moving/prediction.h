#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "config/parameter_table.h"
#include "world/moving/moving_obstacle.h"
#include "world/robot_model.h"

namespace mocha {

/// The deviation of what is predicted at constant velocity, as the covariance of (x, y, vx, vy) [m,
/// m/s] says it. Linear in time, and never less than what the covariance, propagated, asks for:
/// sigma_p + sigma_v t bounds its largest standard deviation whatever place and velocity have in
/// common.
struct PredictedDeviation {
  double place_m;
  double speed;  ///< [m/s]

  /// Throws std::invalid_argument for what is not a covariance.
  static PredictedDeviation of(const Eigen::Matrix4d& covariance);

  double after(double ahead_s) const { return place_m + speed * ahead_s; }
};

/// How many predicted deviations things turn out to be off, with a confidence.
struct PredictionSpread {
  std::vector<double> ahead_s;      ///< ascending
  std::vector<double> confidences;  ///< ascending
  /// A row for each time ahead, a column for each confidence: at that time ...
  Eigen::MatrixXd at;
  /// ... and at any time until then.
  Eigen::MatrixXd throughout;

  /// Of normally distributed errors that are as large as the covariances say.
  static PredictionSpread normal();

  /// Throws std::invalid_argument, saying what is wrong: nothing there, sizes that do not match,
  /// values that are not ascending, confidences outside (0, 1), and times or deviations that are
  /// negative, not finite or above 1000.
  void check() const;

  /// With a confidence, and before a time: interpolated; of what is outside, the nearest.
  double deviations_at(double ahead_s, double confidence) const;
  double deviations_throughout(double ahead_s, double confidence) const;
};

/// Something that moves and promises nothing, predicted at constant velocity. Map frame.
struct PredictedThing {
  std::uint32_t id;
  Vector2 place;     ///< [m]
  Vector2 velocity;  ///< [m/s]
  double radius_m;
  PredictedDeviation deviation;
};

/// All that was seen to move.
struct Predictions {
  double time_s = 0.0;  ///< of the places
  std::vector<PredictedThing> things = {};
  PredictionSpread spread = PredictionSpread::normal();
};

/// What bounds the risk of motions among predicted things.
struct RiskOptions {
  double risk;         ///< that any of the things within reach comes nearer than planned for ...
  double growth_s;     ///< ... at any time until then; later the discs do not grow
  double clearance_m;  ///< that motions keep from the discs, and that things may use up
  double robot_speed;  ///< the robot's highest [m/s]
  double robot_radius_m;

  /// From `risk` and `growth_horizon` of config/local_replanner.yaml.
  static RiskOptions from(const ParameterTable& values, const RobotModel& robot);
};

/// The confidence that each disc has to have: the risk is shared equally among the things that the
/// robot, which is at `place`, can meet within the time for which the discs grow (Boole's
/// inequality). At least 1 - risk.
double confidence_of_each(const Predictions& predictions, const Vector2& place,
                          const RiskOptions& options);

using Discs = std::vector<std::shared_ptr<const MovingObstacle>>;

/// Discs that hold the things with a confidence each, at any time for as long as they grow, but for
/// what sticks out of them by no more than the clearance.
Discs confident_discs(const Predictions& predictions, double confidence,
                      const RiskOptions& options);

/// The same on their most likely courses, without room for what is not known.
Discs likely_discs(const Predictions& predictions);

}  // namespace mocha
