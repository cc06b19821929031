#include "rviz_panel/cells.h"

#include <QHeaderView>

namespace mocha {

void prepare(QTableWidget& table, const QStringList& titles) {
  table.setHorizontalHeaderLabels(titles);
  table.verticalHeader()->hide();
  table.verticalHeader()->setDefaultSectionSize(22);
  table.horizontalHeader()->setStretchLastSection(true);
  table.horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table.setSelectionBehavior(QTableWidget::SelectRows);
  table.setEditTriggers(QTableWidget::NoEditTriggers);
  table.setWordWrap(false);
}

void set_cell(QTableWidget& table, int row, int column, const std::string& text,
              const QColor& background) {
  QTableWidgetItem* cell = table.item(row, column);
  if (!cell) {
    cell = new QTableWidgetItem;
    table.setItem(row, column, cell);
  }
  const QString shown = QString::fromStdString(text);
  cell->setText(shown);
  cell->setToolTip(shown);
  cell->setBackground(background);
  cell->setForeground(Qt::black);
}

}  // namespace mocha
