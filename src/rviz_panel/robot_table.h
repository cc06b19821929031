#pragma once

#include <QTableWidget>
#include <string>
#include <vector>

#include "rviz_panel/robot_words.h"

namespace mocha {

/// The robots of the fleet, what each does and why; one of them is chosen.
class RobotTable : public QTableWidget {
  Q_OBJECT

 public:
  struct Row {
    std::string name;
    RobotWords words;
  };

  explicit RobotTable(QWidget* parent = nullptr);

  /// In this order. The choice stays with its robot; where there is none yet, the first is chosen.
  void show_rows(const std::vector<Row>& rows);
  /// Name of the chosen robot; empty where there is none.
  const std::string& chosen() const { return chosen_; }

 Q_SIGNALS:
  void chosen_changed();

 private:
  void choose(int row);

  std::string chosen_;
};

}  // namespace mocha
