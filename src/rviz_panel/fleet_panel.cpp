#include "rviz_panel/fleet_panel.h"

#include <rviz/display_group.h>
#include <rviz/tool_manager.h>
#include <rviz/visualization_manager.h>
#include <tf2/LinearMath/Quaternion.h>
#include <tf2_geometry_msgs/tf2_geometry_msgs.h>

#include <QCollator>
#include <QHBoxLayout>
#include <QPushButton>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>
#include <pluginlib/class_list_macros.hpp>

#include "rviz_panel/fleet_goal_tool.h"
#include "rviz_panel/map_choice.h"
#include "rviz_panel/waypoint_drawing.h"

namespace mocha {
namespace {

constexpr int kRefresh_ms = 500;
constexpr int kRefreshesToLook = 4;  // for robots

QPushButton* add_button(QBoxLayout& row, const char* name, const QString& text) {
  auto* button = new QPushButton(text);
  button->setObjectName(name);
  row.addWidget(button);
  return button;
}

/// Buttons that end motion at once look like it.
void redden(QPushButton* button) {
  button->setStyleSheet(
      "background-color: #d0302a; color: white; font-weight: bold; padding: 6px;");
}

}  // namespace

FleetPanel::FleetPanel(QWidget* parent)
    : rviz::Panel(parent),
      calls_(std::make_unique<BackgroundCalls>()),
      table_(new RobotTable),
      candidates_(new CandidateTable),
      waypoints_(new WaypointList),
      speed_(new SimulationSpeed(*calls_, [this](const std::string& text) { say(text); })),
      title_(new QLabel),
      said_(new QLabel),
      timer_(new QTimer(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(table_, 2);
  add_robot_controls(*layout);
  add_fleet_controls(*layout);
  layout->addWidget(speed_);
  said_->setObjectName("said");
  said_->setWordWrap(true);
  layout->addWidget(said_);
  connect(table_, &RobotTable::chosen_changed, this, [this] { show_choice(); });
  connect(timer_, &QTimer::timeout, this, [this] { refresh(); });
}

FleetPanel::~FleetPanel() { calls_.reset(); }

void FleetPanel::add_robot_controls(QBoxLayout& layout) {
  title_->setStyleSheet("font-weight: bold;");
  layout.addWidget(title_);
  auto* row = new QHBoxLayout;
  layout.addLayout(row);
  connect(add_button(*row, "pause", "&Pause"), &QPushButton::clicked,
          [this] { turn_chosen(Switch::kPause, true); });
  connect(add_button(*row, "resume", "&Resume"), &QPushButton::clicked,
          [this] { turn_chosen(Switch::kPause, false); });
  connect(add_button(*row, "cancel", "&Cancel"), &QPushButton::clicked, [this] {
    if (RobotClient* robot = chosen()) robot->drive_along({});
  });
  QPushButton* stop = add_button(*row, "stop", "STOP");
  redden(stop);
  connect(stop, &QPushButton::clicked, [this] { turn_chosen(Switch::kEmergencyStop, true); });
  connect(add_button(*row, "reset", "Reset"), &QPushButton::clicked,
          [this] { turn_chosen(Switch::kEmergencyStop, false); });
  layout.addWidget(waypoints_);
  connect(waypoints_, &WaypointList::drive_asked, [this](const nav_msgs::Path& waypoints) {
    if (RobotClient* robot = chosen()) robot->drive_along(waypoints);
  });
  connect(waypoints_, &WaypointList::patrol_asked, [this](const nav_msgs::Path& waypoints) {
    if (RobotClient* robot = chosen()) robot->patrol(waypoints);
  });
  connect(waypoints_, &WaypointList::changed, [this](const nav_msgs::Path& waypoints) {
    waypoint_drawings_.publish(drawing_of(waypoints));
  });
  layout.addWidget(candidates_, 1);
}

void FleetPanel::add_fleet_controls(QBoxLayout& layout) {
  auto* title = new QLabel("All robots");
  title->setStyleSheet("font-weight: bold;");
  layout.addWidget(title);
  auto* row = new QHBoxLayout;
  layout.addLayout(row);
  connect(add_button(*row, "pause_all", "Pause all"), &QPushButton::clicked,
          [this] { turn_all(Switch::kPause, true); });
  connect(add_button(*row, "resume_all", "Resume all"), &QPushButton::clicked,
          [this] { turn_all(Switch::kPause, false); });
  QPushButton* stop = add_button(*row, "stop_all", "STOP ALL");
  redden(stop);
  connect(stop, &QPushButton::clicked, [this] { turn_all(Switch::kFleetEmergencyStop, true); });
  connect(add_button(*row, "reset_all", "Reset all"), &QPushButton::clicked,
          [this] { turn_all(Switch::kFleetEmergencyStop, false); });
}

void FleetPanel::onInitialize() {
  rviz::ToolManager* tools = vis_manager_->getToolManager();
  for (int i = 0; i < tools->numTools(); ++i) listen_to(tools->getTool(i));
  connect(tools, &rviz::ToolManager::toolAdded, this,
          [this](rviz::Tool* tool) { listen_to(tool); });
  diagnostics_ = node_.subscribe("/diagnostics", 100, &FleetPanel::on_diagnostics, this);
  waypoint_drawings_ =
      node_.advertise<visualization_msgs::MarkerArray>("/fleet_panel/waypoints", 1, true);
  timer_->start(kRefresh_ms);
}

void FleetPanel::listen_to(rviz::Tool* tool) {
  if (auto* goals = qobject_cast<FleetGoalTool*>(tool)) {
    connect(goals, &FleetGoalTool::posed, this, &FleetPanel::take_goal);
  }
}

void FleetPanel::take_goal(double x, double y, bool has_yaw, double yaw_rad) {
  geometry_msgs::PoseStamped goal;
  goal.header.frame_id = vis_manager_->getFixedFrame().toStdString();
  goal.pose.position.x = x;
  goal.pose.position.y = y;
  if (has_yaw) {
    tf2::Quaternion heading;
    heading.setRPY(0.0, 0.0, yaw_rad);
    goal.pose.orientation = tf2::toMsg(heading);
  }
  RobotClient* robot = chosen();
  if (waypoints_->gathers()) {
    waypoints_->add(goal);
  } else if (robot) {
    robot->drive_to(goal);
    say(robot->name() + ": is given a goal");
  } else {
    say("no robot is chosen");
  }
}

void FleetPanel::look_for_robots() {
  calls_->add([this] {
    const std::vector<std::string> names = robots_on_master();
    QMetaObject::invokeMethod(
        this, [this, names] { meet(names); }, Qt::QueuedConnection);
  });
}

void FleetPanel::meet(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (robots_.count(name)) continue;
    robots_[name] = std::make_unique<RobotClient>(name, *calls_,
                                                  [this](const std::string& text) { say(text); });
  }
}

void FleetPanel::refresh() {
  if (refreshes_++ % kRefreshesToLook == 0) look_for_robots();
  if (refreshes_ % 2 == 0) speed_->measure();
  std::vector<RobotTable::Row> rows;
  for (const auto& [name, robot] : robots_) rows.push_back({name, robot->words(ros::Time::now())});
  QCollator by_number{QLocale(QLocale::English)};  // ugv2 before ugv10
  by_number.setNumericMode(true);
  std::sort(rows.begin(), rows.end(), [&by_number](const auto& a, const auto& b) {
    return by_number.compare(QString::fromStdString(a.name), QString::fromStdString(b.name)) < 0;
  });
  table_->show_rows(rows);
  RobotClient* robot = chosen();
  candidates_->show_candidates(robot ? robot->candidates() : std::vector<mocha_ugv::Candidate>());
}

void FleetPanel::show_choice() {
  const std::string name = table_->chosen();
  title_->setText(QString::fromStdString(name));
  show_map_of(name, *vis_manager_->getRootDisplayGroup());
}

void FleetPanel::on_diagnostics(const diagnostic_msgs::DiagnosticArray& message) {
  for (const auto& status : message.status) {
    const auto robot = robots_.find(status.hardware_id);
    if (robot != robots_.end()) robot->second->hear(status, ros::Time::now());
  }
}

void FleetPanel::say(const std::string& text) {
  QMetaObject::invokeMethod(
      this, [this, text] { said_->setText(QString::fromStdString(text)); }, Qt::QueuedConnection);
}

RobotClient* FleetPanel::chosen() {
  const auto robot = robots_.find(table_->chosen());
  return robot == robots_.end() ? nullptr : robot->second.get();
}

void FleetPanel::turn_chosen(Switch which, bool on) {
  if (RobotClient* robot = chosen()) robot->turn(which, on);
}

void FleetPanel::turn_all(Switch which, bool on) {
  for (const auto& [name, robot] : robots_) robot->turn(which, on);
}

}  // namespace mocha

PLUGINLIB_EXPORT_CLASS(mocha::FleetPanel, rviz::Panel)
