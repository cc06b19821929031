/// The fleet panel in rviz, used by the mouse, with a simulated fleet of two that runs already:
///
///     rviz_panel_clicks VIEW     (a file for rviz; test/rviz_panel_test.py makes the rest)
#include <gtest/gtest.h>
#include <mocha_ugv/GroundTruth.h>
#include <ros/ros.h>

#include <QAbstractItemView>
#include <QCheckBox>
#include <QComboBox>
#include <QListWidget>
#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "rviz_panel/rviz_window.h"

namespace mocha {
namespace {

constexpr double kAtGoal_m = 0.25;  // tolerance, and the pixel's size
constexpr double kHeading_rad = 0.15;

std::string view_of_rviz;

class FleetPanelClicks : public ::testing::Test {
 protected:
  void SetUp() override {
    truth_ =
        node_.subscribe("/fleet_simulator/ground_truth", 10, &FleetPanelClicks::on_truth, this);
    window_ = std::make_unique<RvizWindow>(view_of_rviz);
    ASSERT_TRUE(window_->until([this] { return does(0, "no goal") && does(1, "no goal"); }))
        << "the panel shows: " << window_->cell("robots", 0, 1);
  }

  void on_truth(const mocha_ugv::GroundTruth& message) {
    for (const auto& robot : message.robots) robots_[robot.name] = robot;
  }

  bool does(int row, const std::string& doing) { return window_->cell("robots", row, 1) == doing; }
  bool until(const std::function<bool()>& is_so) { return window_->until(is_so); }

  double speed(const std::string& name) {
    return std::hypot(robots_[name].speed, robots_[name].yaw_rate);
  }
  bool is_at(const std::string& name, double x, double y) {
    const auto& pose = robots_[name].pose;
    return std::hypot(pose.x - x, pose.y - y) < kAtGoal_m;
  }

  void simulate(double rate) {
    auto& speed = window_->find<QComboBox>("speed");
    window_->click("speed");
    window_->click(
        *speed.view(),
        speed.view()->visualRect(speed.model()->index(speed.findData(rate), 0)).center());
    ASSERT_TRUE(until([this, rate] {
      double now = -1.0;
      return node_.getParam("/fleet_simulator/rate", now) && now == rate;
    }));
  }

  ros::NodeHandle node_;
  ros::Subscriber truth_;
  std::map<std::string, mocha_ugv::RobotTruth> robots_;
  std::unique_ptr<RvizWindow> window_;
};

TEST_F(FleetPanelClicks, DriveAFleet) {
  // The robots that are there, in order; the first one is chosen.
  EXPECT_EQ(window_->cell("robots", 0, 0), "ugv1");
  EXPECT_EQ(window_->cell("robots", 1, 0), "ugv2");

  // The simulation's speed: the robot is not to arrive before the mouse is at the next button.
  ASSERT_NO_FATAL_FAILURE(simulate(0.25));

  // A drag is a goal with a heading, for the robot that is chosen.
  window_->click_row("robots", 1);
  window_->choose_tool("Fleet Goal");
  window_->drag_places(5.0, 3.0, 5.0, 4.5);
  ASSERT_TRUE(until([this] { return does(1, "driving"); }));
  EXPECT_GT(window_->find<QTableWidget>("classes").rowCount(), 0);
  EXPECT_EQ(window_->cell("classes", 0, 4), "driven");
  EXPECT_GT(std::stod(window_->cell("classes", 0, 2)), 0.0);

  // Paused it stands, and keeps its goal.
  window_->click("pause");
  ASSERT_TRUE(until([this] { return does(1, "paused") && speed("ugv2") == 0.0; }));
  EXPECT_FALSE(is_at("ugv2", 5.0, 3.0));
  window_->click("resume");
  ASSERT_NO_FATAL_FAILURE(simulate(2.0));
  ASSERT_TRUE(until([this] { return is_at("ugv2", 5.0, 3.0) && does(1, "parked at its goal"); }));
  EXPECT_NEAR(robots_["ugv2"].pose.theta, M_PI / 2.0, kHeading_rad);
  EXPECT_TRUE(does(0, "no goal"));

  // Goals are gathered, and driven to one after the other.
  window_->click_row("robots", 0);
  window_->click("gather");
  ASSERT_TRUE(window_->find<QCheckBox>("gather").isChecked());
  for (const double x : {2.0, 3.5}) {
    window_->choose_tool("Fleet Goal");
    window_->click_place(x, 1.0);
  }
  ASSERT_TRUE(until([this] { return window_->find<QListWidget>("waypoints").count() == 2; }));
  EXPECT_TRUE(does(0, "no goal"));
  window_->click("drive");
  ASSERT_TRUE(until([this] { return is_at("ugv1", 3.5, 1.0) && does(0, "parked at its goal"); }));

  // Again and again, until it is cancelled.
  window_->click("patrol");
  ASSERT_TRUE(until([this] { return is_at("ugv1", 2.0, 1.0); }));
  ASSERT_TRUE(until([this] { return is_at("ugv1", 3.5, 1.0); }));
  ASSERT_TRUE(until([this] { return is_at("ugv1", 2.0, 1.0); }));
  window_->click("cancel");
  ASSERT_TRUE(until([this] { return does(0, "no goal") && speed("ugv1") == 0.0; }));

  // Emergency stops, of one and of all.
  window_->click("drive");
  ASSERT_TRUE(until([this] { return does(0, "driving"); }));
  window_->click("stop");
  ASSERT_TRUE(until([this] { return does(0, "emergency stop") && speed("ugv1") == 0.0; }));
  EXPECT_FALSE(does(1, "emergency stop"));
  EXPECT_NE(window_->cell("robots", 0, 2), "");
  window_->click("reset");
  ASSERT_TRUE(until([this] { return does(0, "no goal"); }));
  window_->click("stop_all");
  ASSERT_TRUE(until([this] { return does(0, "emergency stop") && does(1, "emergency stop"); }));
  window_->click("reset_all");
  ASSERT_TRUE(until([this] { return !does(0, "emergency stop") && !does(1, "emergency stop"); }));
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  ros::init(argc, argv, "rviz_panel_clicks");
  ::testing::InitGoogleTest(&argc, argv);
  if (argc != 2) return 2;
  mocha::view_of_rviz = argv[1];
  return RUN_ALL_TESTS();
}
