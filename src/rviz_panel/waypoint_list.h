#pragma once

#include <nav_msgs/Path.h>

#include <QCheckBox>
#include <QListWidget>
#include <QWidget>

namespace mocha {

/// Goals that wait to be driven to, one after the other.
class WaypointList : public QWidget {
  Q_OBJECT

 public:
  explicit WaypointList(QWidget* parent = nullptr);

  /// Whether goals of the mouse are gathered here, instead of being driven to at once.
  bool gathers() const { return gathers_->isChecked(); }
  void add(const geometry_msgs::PoseStamped& goal);

 Q_SIGNALS:
  void drive_asked(const nav_msgs::Path& waypoints);
  void patrol_asked(const nav_msgs::Path& waypoints);
  /// The list has other waypoints now.
  void changed(const nav_msgs::Path& waypoints);

 private:
  void remove_selected();
  void clear();
  void announce();

  nav_msgs::Path waypoints_;
  QCheckBox* gathers_;
  QListWidget* shown_;
};

}  // namespace mocha
