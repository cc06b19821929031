#include "rviz_panel/waypoint_list.h"

#include <tf2/utils.h>
#include <tf2_geometry_msgs/tf2_geometry_msgs.h>

#include <QGridLayout>
#include <QPushButton>

namespace mocha {
namespace {

QString text_of(const geometry_msgs::Pose& pose) {
  const QString place =
      QString("(%1, %2)").arg(pose.position.x, 0, 'f', 2).arg(pose.position.y, 0, 'f', 2);
  const auto& q = pose.orientation;
  if (q.x == 0.0 && q.y == 0.0 && q.z == 0.0 && q.w == 0.0) return place;
  return place + QString(", heading %1 rad").arg(tf2::getYaw(q), 0, 'f', 2);
}

}  // namespace

WaypointList::WaypointList(QWidget* parent)
    : QWidget(parent),
      gathers_(new QCheckBox("&Gather goals as waypoints")),
      shown_(new QListWidget) {
  gathers_->setObjectName("gather");
  shown_->setObjectName("waypoints");
  shown_->setMaximumHeight(70);
  auto* layout = new QGridLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(gathers_, 0, 0, 1, 4);
  layout->addWidget(shown_, 1, 0, 1, 4);
  int column = 0;
  const auto add_button = [&](const char* name, const QString& text, auto action) {
    auto* button = new QPushButton(text);
    button->setObjectName(name);
    layout->addWidget(button, 2, column++);
    connect(button, &QPushButton::clicked, this, action);
  };
  add_button("drive", "&Drive", [this] { Q_EMIT drive_asked(waypoints_); });
  add_button("patrol", "Pa&trol", [this] { Q_EMIT patrol_asked(waypoints_); });
  add_button("remove", "Remove", [this] { remove_selected(); });
  add_button("clear", "Clear", [this] { clear(); });
}

void WaypointList::add(const geometry_msgs::PoseStamped& goal) {
  waypoints_.header = goal.header;
  waypoints_.poses.push_back(goal);
  announce();
}

void WaypointList::remove_selected() {
  const int row = shown_->currentRow();
  if (row < 0) return;
  waypoints_.poses.erase(waypoints_.poses.begin() + row);
  announce();
}

void WaypointList::clear() {
  waypoints_.poses.clear();
  announce();
}

void WaypointList::announce() {
  shown_->clear();
  for (const auto& goal : waypoints_.poses) shown_->addItem(text_of(goal.pose));
  Q_EMIT changed(waypoints_);
}

}  // namespace mocha
