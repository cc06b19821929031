#pragma once

#include <QColor>
#include <QStringList>
#include <QTableWidget>
#include <string>

namespace mocha {

/// Makes a table of whole rows, which are read and not edited. The last column takes what is left
/// of the width.
void prepare(QTableWidget& table, const QStringList& titles);

/// The whole text is also the tip, where the cell is too narrow for it.
void set_cell(QTableWidget& table, int row, int column, const std::string& text,
              const QColor& background);

}  // namespace mocha
