#include "rviz_panel/robot_table.h"

#include <QColor>
#include <QHeaderView>

#include "rviz_panel/cells.h"

namespace mocha {
namespace {

QColor colour_of(RobotMood mood) {
  switch (mood) {
    case RobotMood::kSilent:
      return {200, 200, 200};
    case RobotMood::kStopped:
      return {255, 120, 110};
    case RobotMood::kTroubled:
      return {255, 200, 130};
    case RobotMood::kEvading:
      return {255, 240, 150};
    case RobotMood::kResting:
      return {240, 240, 240};
    case RobotMood::kDriving:
      return {190, 235, 180};
  }
  return {};
}

}  // namespace

RobotTable::RobotTable(QWidget* parent) : QTableWidget(0, 3, parent) {
  setObjectName("robots");
  prepare(*this, {"Robot", "Does", "Why"});
  setSelectionMode(SingleSelection);
  connect(this, &QTableWidget::itemSelectionChanged, this, &RobotTable::chosen_changed);
}

void RobotTable::show_rows(const std::vector<Row>& rows) {
  const std::string before = chosen();
  const bool same_robots = rowCount() == static_cast<int>(rows.size());
  {
    const QSignalBlocker silence(this);
    setRowCount(static_cast<int>(rows.size()));
    int chosen_row = rows.empty() ? -1 : 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto& [name, words] = rows[i];
      const int row = static_cast<int>(i);
      set_cell(*this, row, 0, name, colour_of(words.mood));
      set_cell(*this, row, 1, words.doing, colour_of(words.mood));
      set_cell(*this, row, 2, words.why, colour_of(words.mood));
      if (name == before) chosen_row = row;
    }
    if (chosen_row >= 0 && (!same_robots || chosen() != before || before.empty()))
      selectRow(chosen_row);
  }
  if (chosen() != before) Q_EMIT chosen_changed();
}

std::string RobotTable::chosen() const {
  const QList<QTableWidgetItem*> items = selectedItems();
  return items.empty() ? "" : item(items.front()->row(), 0)->text().toStdString();
}

}  // namespace mocha
