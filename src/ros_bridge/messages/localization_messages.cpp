#include "ros_bridge/messages/localization_messages.h"

#include <cmath>
#include <cstdio>

#include "ros_bridge/messages/conversions.h"
#include "ros_bridge/messages/covariances.h"

namespace mocha {
namespace {

constexpr double kLeastSaid_m = 0.2;
constexpr double kLeastSaid_rad = 0.1;

double sigma_position_m(const Localization& localization) {
  return std::sqrt(localization.base.covariance.topLeftCorner<2, 2>().trace());
}

std::string words_of(const Localization& localization) {
  char text[128];
  switch (localization.state) {
    case Localization::State::kLocalized:
      std::snprintf(text, sizeof(text), "localised, to within %.0f mm; the map explains %.0f %%",
                    1e3 * sigma_position_m(localization), 1e2 * localization.quality);
      return text;
    case Localization::State::kAmbiguous:
      if (localization.places == 1) {
        std::snprintf(text, sizeof(text), "one place, still on trial: the map explains %.0f %%",
                      1e2 * localization.quality);
      } else {
        std::snprintf(text, sizeof(text),
                      "%d places look like this: drive on by hand, or give an initialpose",
                      localization.places);
      }
      return text;
    case Localization::State::kLost:
      break;
  }
  return localization.searched_in_vain
             ? "lost: the map is too large or too uniform to be searched; give an initialpose"
             : "lost: no place in the map looks like this";
}

}  // namespace

mocha_ugv::Localization to_message(const Localization& localization, const RobotIdentity& robot) {
  static_assert(static_cast<int>(Localization::State::kLost) == mocha_ugv::Localization::LOST);
  static_assert(static_cast<int>(Localization::State::kAmbiguous) ==
                mocha_ugv::Localization::AMBIGUOUS);
  static_assert(static_cast<int>(Localization::State::kLocalized) ==
                mocha_ugv::Localization::LOCALIZED);
  mocha_ugv::Localization message;
  message.header.stamp = ros::Time(localization.time_s);
  message.header.frame_id = robot.map_frame;
  message.state = static_cast<std::uint8_t>(localization.state);
  message.quality = localization.quality;
  message.sigma_position = sigma_position_m(localization);
  message.sigma_yaw = std::sqrt(localization.base.covariance(2, 2));
  message.places = localization.places;
  message.message = words_of(localization);
  return message;
}

geometry_msgs::PoseWithCovarianceStamped pose_message(const Localization& localization,
                                                      const RobotIdentity& robot) {
  geometry_msgs::PoseWithCovarianceStamped message;
  message.header.stamp = ros::Time(localization.time_s);
  message.header.frame_id = robot.map_frame;
  message.pose.pose = to_message(localization.base.pose);
  put_covariance(localization.base.covariance, message.pose.covariance);
  return message;
}

geometry_msgs::TransformStamped map_to_odom(const Localization& localization,
                                            const RobotIdentity& robot) {
  return transform_message(ros::Time(localization.time_s), robot.map_frame, robot.odom_frame,
                           localization.odom_in_map);
}

std::optional<PoseEstimate> from_message(const geometry_msgs::PoseWithCovarianceStamped& message,
                                         const std::string& map_frame, std::string& fault) {
  if (message.header.frame_id != map_frame) {
    fault = "in frame `" + message.header.frame_id + "` instead of " + map_frame;
    return std::nullopt;
  }
  PoseEstimate said{from_message(message.pose.pose), planar_covariance(message.pose.covariance)};
  const Eigen::Vector3d least(kLeastSaid_m, kLeastSaid_m, kLeastSaid_rad);
  for (int axis = 0; axis < 3; ++axis) {
    said.covariance(axis, axis) = std::max(said.covariance(axis, axis), least[axis] * least[axis]);
  }
  fault = fault_of(said);
  if (!fault.empty()) return std::nullopt;
  return said;
}

}  // namespace mocha
