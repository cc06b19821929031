#include "rviz_panel/robot_words.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

const ros::Time kNow(100.0);

RobotNews driving() {
  RobotNews news;
  news.heard = kNow;
  news.state = "driving";
  news.planner.emplace().reason = mocha_ugv::PlannerStatus::SOLVED;
  news.planner->message = "waypoint 1 of 2";
  news.replanner.emplace().row = mocha_ugv::ReplannerStatus::FOLLOW;
  news.stop.emplace().stopped = false;
  news.localization.emplace().state = mocha_ugv::Localization::LOCALIZED;
  return news;
}

TEST(RobotWords, SaysWhatARobotDoes) {
  const RobotWords words = words_of(driving(), kNow);
  EXPECT_EQ(words.mood, RobotMood::kDriving);
  EXPECT_EQ(words.doing, "driving");
  EXPECT_EQ(words.why, "waypoint 1 of 2");
}

TEST(RobotWords, TheWorstComesFirst) {
  RobotNews news = driving();
  news.replanner->row = mocha_ugv::ReplannerStatus::DETOUR;
  news.replanner->doing = "detour";
  news.replanner->status.message = "0.2 m to a person";
  EXPECT_EQ(words_of(news, kNow).mood, RobotMood::kEvading);
  EXPECT_EQ(words_of(news, kNow).doing, "detour");
  EXPECT_EQ(words_of(news, kNow).why, "0.2 m to a person");

  news.planner->reason = mocha_ugv::PlannerStatus::NO_PATH;
  news.planner->message = "no path leads there";
  news.state = "without a plan";
  EXPECT_EQ(words_of(news, kNow).mood, RobotMood::kTroubled);
  EXPECT_EQ(words_of(news, kNow).doing, "without a plan");
  EXPECT_EQ(words_of(news, kNow).why, "no path leads there");

  news.localization->state = mocha_ugv::Localization::LOST;
  news.localization->message = "no place explains the scans";
  EXPECT_EQ(words_of(news, kNow).doing, "does not know where it is");
  EXPECT_EQ(words_of(news, kNow).why, "no place explains the scans");

  news.stop->stopped = true;
  news.stop->message = "ordered at ugv2";
  EXPECT_EQ(words_of(news, kNow).mood, RobotMood::kStopped);
  EXPECT_EQ(words_of(news, kNow).why, "ordered at ugv2");

  EXPECT_EQ(words_of(news, kNow + ros::Duration(3.1)).mood, RobotMood::kSilent);
}

TEST(RobotWords, OneThatRestsExplainsNothing) {
  RobotNews news = driving();
  news.planner->reason = mocha_ugv::PlannerStatus::NO_PATH;  // of a goal that was given up
  for (const char* state : {"no goal", "parked at its goal", "paused"}) {
    news.state = state;
    EXPECT_EQ(words_of(news, kNow).mood, RobotMood::kResting);
    EXPECT_EQ(words_of(news, kNow).doing, state);
    EXPECT_EQ(words_of(news, kNow).why, "");
  }
}

TEST(RobotWords, ARobotThatWasNeverHeardIsSilent) {
  EXPECT_EQ(words_of({}, kNow).mood, RobotMood::kSilent);
}

}  // namespace
}  // namespace mocha
