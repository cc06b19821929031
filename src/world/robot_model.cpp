#include "world/robot_model.h"

#include <cmath>

#include "world/robot_values.h"

namespace mocha {
namespace {

// Of an acceleration limit, where there is time: a comfortable stop.
constexpr double kBrakingShare = 0.6;
constexpr double kTold = 1e3;               // counts in 1 m/s^2 of a braking that peers are told
constexpr double kBrakingOvershoot = 1.15;  // of a braking curve over its deceleration

constexpr double kTurnOvershoot = 1.02;  // the same of a turn in place that is ended

/// The highest number that peers can be told, and is not above the acceleration.
double told(double acceleration) {
  constexpr double kRounding = 1e-6;
  return std::floor(acceleration * kTold + kRounding) / kTold;
}

}  // namespace

bool LidarModel::sees_all_round() const {
  constexpr double kRounding_rad = 1e-4;  // of 6.2831853
  return field_of_view_rad >= 2.0 * M_PI - kRounding_rad;
}

bool LidarModel::sees(const Vector2& in_body) const {
  const Vector2 beam = in_body - mount.position;
  const double angle_rad = wrap_angle(std::atan2(beam.y(), beam.x()) - mount.yaw_rad);
  return beam.norm() >= min_range_m &&
         (sees_all_round() || std::abs(angle_rad) <= 0.5 * field_of_view_rad);
}

Braking RobotModel::braking() const {
  return Braking(told(kBrakingShare * limits.max_acceleration), told(limits.max_acceleration),
                 limits.max_yaw_acceleration / kTurnOvershoot);
}

Braking RobotModel::hard_braking() const {
  return Braking(emergency_acceleration / kBrakingOvershoot, emergency_acceleration,
                 limits.max_yaw_acceleration / kTurnOvershoot);
}

MotionLimits RobotModel::emergency_limits() const {
  MotionLimits harder = limits;
  harder.max_acceleration = emergency_acceleration;
  return harder;
}

RobotModel load_robot_model(const std::string& config_directory, const std::string& model) {
  return robot_model_of(load_robot_values(config_directory, model), model,
                        robot_values_file(config_directory, model));
}

}  // namespace mocha
