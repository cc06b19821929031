#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "trajectory/motion.h"
#include "trajectory/unicycle.h"

namespace mocha {

/// Acceleration [m/s^2], gravity included, and rates [rad/s] about the axes of base_link.
struct ImuReading {
  Eigen::Vector3d acceleration;
  Eigen::Vector3d rate;
};

/// What a base says of itself at one time.
struct BaseFeedback {
  double stamp_s = 0.0;
  Pose pose;  ///< by its wheels, in the odometry frame, which begins where the first feedback came
  Eigen::Matrix3d pose_covariance = Eigen::Matrix3d::Zero();  ///< of x, y, yaw in that frame
  UnicycleState twist = {0.0, 0.0};
  double speed_variance = 0.0;
  double yaw_rate_variance = 0.0;
  std::optional<ImuReading> imu;
  std::optional<double> battery_v;
};

/// A base that drives as a unicycle: all that the driver node knows of one. Another kind of base is
/// another implementation.
///
/// Nothing here waits: poll() and drive() do what can be done at once. Times are in seconds of one
/// clock, the caller's.
class BaseInterface {
 public:
  virtual ~BaseInterface() = default;

  /// Listens, and looks after the connection: call it often. Returned is what came since the last
  /// call, in order.
  virtual std::vector<BaseFeedback> poll(double now_s) = 0;

  /// Whether the base answers: feedback came a short while ago. A base that does not is not driven.
  virtual bool connected(double now_s) const = 0;

  /// Drives so until the next call, or until the base itself finds that commands stay away. What is
  /// beyond the wheels is slowed down with the curvature kept. Nothing where there is no
  /// connection.
  virtual void drive(const UnicycleState& command) = 0;

  /// Stops as fast as the base can, and holds it; or lets it go again.
  virtual void set_emergency_stop(bool stopped) = 0;

  /// Why it is not connected, in words a driver understands; empty where it is.
  virtual std::string fault(double now_s) const = 0;

  /// What was counted, for diagnostics: name and value.
  virtual std::vector<std::pair<std::string, std::string>> details() const = 0;
};

}  // namespace mocha
