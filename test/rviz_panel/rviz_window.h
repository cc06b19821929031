#pragma once

#include <rviz/visualization_frame.h>

#include <QApplication>
#include <QPoint>
#include <QTableWidget>
#include <QWidget>
#include <functional>
#include <string>

namespace mocha {

/// rviz with a view, as somebody at a screen uses it: found by the names of its widgets, used by
/// the mouse of the X server (xdotool).
class RvizWindow {
 public:
  explicit RvizWindow(const std::string& view);

  /// Serves the window and ROS until something is so, at most a minute. Returns whether it is.
  bool until(const std::function<bool()>& is_so);

  template <typename Widget>
  Widget& find(const QString& name) {
    Widget* found = frame_.findChild<Widget*>(name);
    if (!found) throw std::runtime_error("there is no " + name.toStdString());
    return *found;
  }

  void click(QWidget& widget, QPoint at);
  void click(const QString& name);
  /// A row of a table.
  void click_row(const QString& table, int row);
  /// Text of a cell; empty where there is none.
  std::string cell(const QString& table, int row, int column);
  /// The tool of a name in the tool bar.
  void choose_tool(const QString& name);
  /// Places in the fixed frame [m]: a click, or from the first to the second with the button down.
  void click_place(double x, double y);
  void drag_places(double x, double y, double to_x, double to_y);

 private:
  QPoint pixel_of(double x, double y);
  /// Runs xdotool to its end.
  void use_mouse(const QStringList& words);

  rviz::VisualizationFrame frame_;
};

}  // namespace mocha
