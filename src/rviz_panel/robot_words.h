#pragma once

#include <mocha_ugv/EmergencyStopState.h>
#include <mocha_ugv/Localization.h>
#include <mocha_ugv/PlannerStatus.h>
#include <mocha_ugv/ReplannerStatus.h>
#include <ros/time.h>

#include <optional>
#include <string>

namespace mocha {

/// The newest that a robot has said of itself.
struct RobotNews {
  ros::Time heard;    ///< when its planner last said anything; 0: never
  std::string state;  ///< of its goal executive, as in its diagnostics
  std::optional<mocha_ugv::PlannerStatus> planner;
  std::optional<mocha_ugv::ReplannerStatus> replanner;
  std::optional<mocha_ugv::EmergencyStopState> stop;
  std::optional<mocha_ugv::Localization> localization;
};

/// How well a robot is, from the worst to the best.
enum class RobotMood { kSilent, kStopped, kTroubled, kEvading, kResting, kDriving };

/// What a robot does, and why, for people.
struct RobotWords {
  RobotMood mood;
  std::string doing;
  std::string why;  ///< empty where there is nothing to explain
};

/// The worst of what a robot says comes first: that it is silent, stopped, lost, without a way, out
/// of the way of something.
RobotWords words_of(const RobotNews& news, ros::Time now);

}  // namespace mocha
