#include "rviz_panel/robot_table.h"

#include <QColor>
#include <QHeaderView>
#include <algorithm>

#include "rviz_panel/cells.h"

namespace mocha {
namespace {

constexpr int kLeastRows = 2;  // in sight
constexpr int kMostRows = 10;  // of more, some are scrolled to

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
  connect(this, &QTableWidget::itemSelectionChanged, this, [this] {
    const QList<QTableWidgetItem*> items = selectedItems();
    if (!items.empty()) choose(items.front()->row());
  });
}

void RobotTable::show_rows(const std::vector<Row>& rows) {
  int chosen_row = 0;
  {
    const QSignalBlocker silence(this);
    setRowCount(static_cast<int>(rows.size()));
    int row = 0;
    for (const auto& [name, words] : rows) {
      const QColor colour = colour_of(words.mood);
      set_cell(*this, row, 0, name, colour);
      set_cell(*this, row, 1, words.doing, colour);
      set_cell(*this, row, 2, words.why, colour);
      if (name == chosen_) chosen_row = row;
      ++row;
    }
    if (row > 0) selectRow(chosen_row);
    const int rows_shown = std::clamp(row, kLeastRows, kMostRows);
    setMinimumHeight((rows_shown + 1) * verticalHeader()->defaultSectionSize() + 2 * frameWidth());
  }
  if (!rows.empty()) choose(chosen_row);
}

/// The colour of the row still says how the robot is.
void RobotTable::choose(int row) {
  QPalette colours = palette();
  colours.setColor(QPalette::Highlight, item(row, 0)->background().color().darker(130));
  colours.setColor(QPalette::HighlightedText, Qt::black);
  setPalette(colours);
  const std::string name = item(row, 0)->text().toStdString();
  if (name == chosen_) return;
  chosen_ = name;
  Q_EMIT chosen_changed();
}

}  // namespace mocha
