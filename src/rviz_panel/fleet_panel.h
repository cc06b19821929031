#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <nav_msgs/Path.h>
#include <ros/node_handle.h>
#include <rviz/panel.h>

#include <QLabel>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "rviz_panel/background_calls.h"
#include "rviz_panel/candidate_table.h"
#include "rviz_panel/robot_client.h"
#include "rviz_panel/robot_table.h"
#include "rviz_panel/simulation_speed.h"
#include "rviz_panel/waypoint_list.h"

class QBoxLayout;
class QTimer;

namespace rviz {
class Tool;
}

namespace mocha {

/// The fleet at a glance and at hand: what each robot does and why; goals, waypoints, pause and
/// emergency stop for the one that is chosen, and for all. Robots appear as their nodes do.
class FleetPanel : public rviz::Panel {
  Q_OBJECT

 public:
  explicit FleetPanel(QWidget* parent = nullptr);
  ~FleetPanel() override;
  void onInitialize() override;

 private:
  using Switch = RobotClient::Switch;

  void add_robot_controls(QBoxLayout& layout);
  void add_fleet_controls(QBoxLayout& layout);
  void listen_to(rviz::Tool* tool);
  void take_goal(double x, double y, bool has_yaw, double yaw_rad);
  void look_for_robots();
  void meet(const std::vector<std::string>& names);
  void refresh();
  void show_choice();
  void on_diagnostics(const diagnostic_msgs::DiagnosticArray& message);
  /// May be called on any thread.
  void say(const std::string& text);

  RobotClient* chosen();
  void turn_chosen(Switch which, bool on);
  void turn_all(Switch which, bool on);

  std::unique_ptr<BackgroundCalls> calls_;
  std::map<std::string, std::unique_ptr<RobotClient>> robots_;
  RobotTable* table_;
  CandidateTable* candidates_;
  WaypointList* waypoints_;
  SimulationSpeed* speed_;
  QLabel* title_;
  QLabel* said_;
  QTimer* timer_;
  int refreshes_ = 0;
  ros::NodeHandle node_;
  ros::Subscriber diagnostics_;
  ros::Publisher waypoint_drawings_;
};

}  // namespace mocha
