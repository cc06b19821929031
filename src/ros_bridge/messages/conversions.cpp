#include "ros_bridge/messages/conversions.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "trajectory/descriptor.h"

namespace mocha {
namespace {

constexpr int kOrder = 3;

void put_derivatives(const Eigen::Matrix2d& derivatives, std::vector<double>& values) {
  values.assign(derivatives.data(), derivatives.data() + derivatives.size());
}

void get_derivatives(const std::vector<double>& values, Eigen::Matrix2d& derivatives) {
  if (values.size() != 4)
    throw std::invalid_argument("Trajectory: a drive's derivatives need 4 values");
  std::copy(values.begin(), values.end(), derivatives.data());
}

std::vector<double> values_of(const TurnRates& rates) {
  return {rates.yaw_rate, rates.yaw_acceleration};
}

TurnRates rates_of(const std::vector<double>& values) {
  if (values.empty()) return {};
  if (values.size() != 2)
    throw std::invalid_argument("Trajectory: a turn's derivatives need 2 values or none");
  return {values[0], values[1]};
}

mocha_ugv::MotionPhase to_message(const PhaseDescriptor& phase) {
  mocha_ugv::MotionPhase message;
  message.kind = static_cast<uint8_t>(phase.kind);
  message.direction = static_cast<int8_t>(phase.direction);
  message.yaw_start = phase.yaw_start_rad;
  message.yaw_change = phase.yaw_change_rad;
  message.durations = phase.durations_s;
  for (const Vector2& point : phase.points) {
    message.x.push_back(point.x());
    message.y.push_back(point.y());
  }
  if (phase.kind == PhaseDescriptor::Kind::kDrive) {
    put_derivatives(phase.start_derivatives, message.start_derivatives);
    put_derivatives(phase.end_derivatives, message.end_derivatives);
  } else if (phase.kind == PhaseDescriptor::Kind::kTurn) {
    message.start_derivatives = values_of(phase.start_rates);
    message.end_derivatives = values_of(phase.end_rates);
  }
  return message;
}

PhaseDescriptor from_message(const mocha_ugv::MotionPhase& message) {
  if (message.kind > mocha_ugv::MotionPhase::STAND) {
    throw std::invalid_argument("Trajectory: unknown kind of phase");
  }
  if (message.x.size() != message.y.size()) {
    throw std::invalid_argument("Trajectory: x and y differ in size");
  }
  PhaseDescriptor phase;
  phase.kind = static_cast<PhaseDescriptor::Kind>(message.kind);
  phase.direction = message.direction;
  phase.yaw_start_rad = message.yaw_start;
  phase.yaw_change_rad = message.yaw_change;
  phase.durations_s = message.durations;
  for (std::size_t i = 0; i < message.x.size(); ++i) {
    phase.points.emplace_back(message.x[i], message.y[i]);
  }
  if (phase.kind == PhaseDescriptor::Kind::kDrive) {
    get_derivatives(message.start_derivatives, phase.start_derivatives);
    get_derivatives(message.end_derivatives, phase.end_derivatives);
  } else if (phase.kind == PhaseDescriptor::Kind::kTurn) {
    phase.start_rates = rates_of(message.start_derivatives);
    phase.end_rates = rates_of(message.end_derivatives);
  }
  return phase;
}

}  // namespace

void to_message(const Motion& motion, mocha_ugv::Trajectory& message) {
  const MotionDescriptor descriptor = describe(motion);
  message.start = ros::Time(descriptor.start_time_s);
  message.s = kOrder;
  message.phases.clear();
  for (const PhaseDescriptor& phase : descriptor.phases)
    message.phases.push_back(to_message(phase));
}

void to_message(const Braking& braking, mocha_ugv::Trajectory& message) {
  message.deceleration = braking.deceleration();
  message.max_acceleration = braking.max_acceleration();
}

Braking braking_from_message(const mocha_ugv::Trajectory& message) {
  return Braking(message.deceleration, message.max_acceleration);
}

Motion from_message(const mocha_ugv::Trajectory& message) {
  if (message.s != kOrder) throw std::invalid_argument("Trajectory: s is not 3");
  MotionDescriptor descriptor;
  descriptor.start_time_s = message.start.toSec();
  for (const auto& phase : message.phases) descriptor.phases.push_back(from_message(phase));
  return rebuild(descriptor);
}

geometry_msgs::TransformStamped transform_message(ros::Time stamp, const std::string& parent,
                                                  const std::string& child, const Pose& pose,
                                                  double height_m) {
  geometry_msgs::TransformStamped message;
  message.header.stamp = stamp;
  message.header.frame_id = parent;
  message.child_frame_id = child;
  message.transform.translation.x = pose.position.x();
  message.transform.translation.y = pose.position.y();
  message.transform.translation.z = height_m;
  message.transform.rotation = quaternion_of(pose.yaw_rad);
  return message;
}

ros::Time ros_time(double t) {
  constexpr double kLatest_s = 4294967295.0;
  return t >= 0.0 && t < kLatest_s ? ros::Time(t) : ros::Time();
}

geometry_msgs::Quaternion quaternion_of(double yaw_rad) {
  geometry_msgs::Quaternion quaternion;
  quaternion.z = std::sin(0.5 * yaw_rad);
  quaternion.w = std::cos(0.5 * yaw_rad);
  return quaternion;
}

geometry_msgs::Pose to_message(const Pose& pose) {
  geometry_msgs::Pose message;
  message.position.x = pose.position.x();
  message.position.y = pose.position.y();
  message.orientation = quaternion_of(pose.yaw_rad);
  return message;
}

Pose from_message(const geometry_msgs::Pose& pose) {
  const auto& q = pose.orientation;
  const double yaw = std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
  return {Vector2(pose.position.x, pose.position.y), yaw};
}

}  // namespace mocha
