#include "rviz_panel/rviz_window.h"

#include <rviz/properties/property.h>
#include <rviz/render_panel.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>
#include <rviz/visualization_manager.h>

#include <QCheckBox>
#include <QElapsedTimer>
#include <QProcess>
#include <QPushButton>
#include <QToolButton>
#include <cmath>
#include <stdexcept>

namespace mocha {
namespace {

constexpr int kPatience_ms = 60000;
constexpr int kServe_ms = 20;

QString number(int value) { return QString::number(value); }

}  // namespace

RvizWindow::RvizWindow(const std::string& view) {
  frame_.setSplashPath("");
  frame_.initialize(QString::fromStdString(view));
  frame_.show();
}

bool RvizWindow::until(const std::function<bool()>& is_so) {
  QElapsedTimer waited;
  waited.start();
  while (!is_so()) {
    if (waited.elapsed() > kPatience_ms) return false;
    QApplication::processEvents(QEventLoop::AllEvents | QEventLoop::WaitForMoreEvents, kServe_ms);
  }
  return true;
}

void RvizWindow::use_mouse(const QStringList& words) {
  QProcess mouse;
  mouse.start("xdotool", words);
  if (!until([&mouse] { return mouse.state() == QProcess::NotRunning; }) || mouse.exitCode() != 0)
    throw std::runtime_error("xdotool fails: " + words.join(" ").toStdString());
  QApplication::processEvents();
}

void RvizWindow::click(QWidget& widget, QPoint at) {
  const QPoint place = widget.mapToGlobal(at);
  use_mouse({"mousemove", "--sync", number(place.x()), number(place.y()), "click", "1"});
}

void RvizWindow::click(const QString& name) {
  QWidget& widget = find<QWidget>(name);
  const int middle_px = widget.height() / 2;  // of a box to be ticked, only what is drawn counts
  click(widget,
        qobject_cast<QCheckBox*>(&widget) ? QPoint(middle_px, middle_px) : widget.rect().center());
}

void RvizWindow::click_row(const QString& table, int row) {
  auto& widget = find<QTableWidget>(table);
  click(*widget.viewport(), widget.visualItemRect(widget.item(row, 0)).center());
}

std::string RvizWindow::cell(const QString& table, int row, int column) {
  const QTableWidgetItem* item = find<QTableWidget>(table).item(row, column);
  return item ? item->text().toStdString() : "";
}

void RvizWindow::choose_tool(const QString& name) {
  for (QToolButton* button : frame_.findChildren<QToolButton*>()) {
    if (button->text() == name && button->isVisible())
      return click(*button, button->rect().center());
  }
  throw std::runtime_error("there is no tool " + name.toStdString());
}

QPoint RvizWindow::pixel_of(double x, double y) {
  rviz::VisualizationManager& manager = *frame_.getManager();
  rviz::ViewController& eye = *manager.getViewManager()->getCurrent();
  const double scale = eye.subProp("Scale")->getValue().toDouble();
  const double centre_x = eye.subProp("X")->getValue().toDouble();
  const double centre_y = eye.subProp("Y")->getValue().toDouble();
  const QPoint centre = manager.getRenderPanel()->rect().center();
  return centre + QPoint(static_cast<int>(std::lround(scale * (x - centre_x))),
                         static_cast<int>(std::lround(-scale * (y - centre_y))));
}

void RvizWindow::click_place(double x, double y) {
  click(*frame_.getManager()->getRenderPanel(), pixel_of(x, y));
}

void RvizWindow::drag_places(double x, double y, double to_x, double to_y) {
  QWidget& panel = *frame_.getManager()->getRenderPanel();
  const QPoint from = panel.mapToGlobal(pixel_of(x, y));
  const QPoint to = panel.mapToGlobal(pixel_of(to_x, to_y));
  use_mouse({"mousemove", "--sync", number(from.x()), number(from.y()), "mousedown", "1"});
  use_mouse(
      {"mousemove", "--sync", number((from.x() + to.x()) / 2), number((from.y() + to.y()) / 2)});
  use_mouse({"mousemove", "--sync", number(to.x()), number(to.y()), "mouseup", "1"});
}

}  // namespace mocha
