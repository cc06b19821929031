#include "rviz_panel/fleet_goal_tool.h"

#include <rviz/load_resource.h>
#include <rviz/viewport_mouse_event.h>

#include <pluginlib/class_list_macros.hpp>

namespace mocha {
namespace {

constexpr int kDrag_px = 8;  // less is the shake of a hand that clicks

}  // namespace

FleetGoalTool::FleetGoalTool() { shortcut_key_ = 'f'; }

void FleetGoalTool::onInitialize() {
  PoseTool::onInitialize();
  setName("Fleet Goal");
  setDescription("Give a goal to the robot that is chosen in the fleet panel: click, or drag");
  setIcon(rviz::loadPixmap("package://rviz/icons/classes/SetGoal.png"));
}

int FleetGoalTool::processMouseEvent(rviz::ViewportMouseEvent& event) {
  const QPoint at_px(event.x, event.y);
  if (event.leftDown()) {
    pressed_px_ = at_px;
    dragged_ = false;
  }
  if ((at_px - pressed_px_).manhattanLength() > kDrag_px) dragged_ = true;
  return PoseTool::processMouseEvent(event);
}

void FleetGoalTool::onPoseSet(double x, double y, double yaw_rad) {
  Q_EMIT posed(x, y, dragged_, yaw_rad);
}

}  // namespace mocha

PLUGINLIB_EXPORT_CLASS(mocha::FleetGoalTool, rviz::Tool)
