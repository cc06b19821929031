#pragma once

#include <rviz/default_plugin/tools/pose_tool.h>

#include <QPoint>
#include <optional>

namespace mocha {

/// Takes a goal from the mouse: a click is a place, a drag a place and a heading. It is for the
/// robot that is chosen in the panel.
class FleetGoalTool : public rviz::PoseTool {
  Q_OBJECT

 public:
  FleetGoalTool();
  void onInitialize() override;
  int processMouseEvent(rviz::ViewportMouseEvent& event) override;

 Q_SIGNALS:
  /// In the fixed frame [m, rad]; `has_yaw` is false for a click.
  void posed(double x, double y, bool has_yaw, double yaw_rad);

 protected:
  void onPoseSet(double x, double y, double yaw_rad) override;

 private:
  QPoint pressed_px_;
  bool dragged_ = false;
};

}  // namespace mocha
