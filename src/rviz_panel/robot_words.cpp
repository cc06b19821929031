#include "rviz_panel/robot_words.h"

namespace mocha {
namespace {

const ros::Duration kSilence(3.0);  // diagnostics come once a second

bool plans(const mocha_ugv::PlannerStatus& status) {
  using Status = mocha_ugv::PlannerStatus;
  return status.reason == Status::SOLVED || status.reason == Status::NO_GOAL ||
         status.reason == Status::BRAKING || status.reason == Status::PAUSED;
}

bool keeps_to_plan(const mocha_ugv::ReplannerStatus& status) {
  using Status = mocha_ugv::ReplannerStatus;
  return status.row == Status::KEEP || status.row == Status::WAIT || status.row == Status::STAND ||
         status.row == Status::FOLLOW || status.row == Status::STOP;
}

bool rests(const std::string& state) {
  return state.empty() || state == "no goal" || state == "parked at its goal" || state == "paused";
}

}  // namespace

RobotWords words_of(const RobotNews& news, ros::Time now) {
  if (news.heard.isZero() || now - news.heard > kSilence) {
    return {RobotMood::kSilent, "silent", "its planner has said nothing for 3 s"};
  }
  if (news.stop && news.stop->stopped) {
    return {RobotMood::kStopped, "emergency stop", news.stop->message};
  }
  if (news.localization && news.localization->state != mocha_ugv::Localization::LOCALIZED) {
    return {RobotMood::kTroubled, "does not know where it is", news.localization->message};
  }
  if (rests(news.state)) {
    return {RobotMood::kResting, news.state.empty() ? "no goal" : news.state, ""};
  }
  if (news.planner && !plans(*news.planner)) {
    return {RobotMood::kTroubled, news.state, news.planner->message};
  }
  if (news.replanner && !keeps_to_plan(*news.replanner)) {
    return {RobotMood::kEvading, news.replanner->doing, news.replanner->status.message};
  }
  return {RobotMood::kDriving, news.state, news.planner ? news.planner->message : ""};
}

}  // namespace mocha
