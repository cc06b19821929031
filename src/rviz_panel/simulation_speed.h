#pragma once

#include <ros/time.h>

#include <QComboBox>
#include <QLabel>
#include <QWidget>
#include <functional>
#include <string>

#include "rviz_panel/background_calls.h"

namespace mocha {

/// How fast simulated time goes. Hidden where time is not simulated.
class SimulationSpeed : public QWidget {
  Q_OBJECT

 public:
  /// `calls` must outlive this. `say` hears what became of a change, on the thread of `calls`.
  SimulationSpeed(BackgroundCalls& calls, std::function<void(std::string)> say,
                  QWidget* parent = nullptr);

  /// Shows the speed since the last call, about a second ago.
  void measure();

 private:
  void ask_for(double rate);
  /// What the simulator is told at its start, which may be none of the choices.
  void show_rate(double rate);

  BackgroundCalls& calls_;
  std::function<void(std::string)> say_;
  QComboBox* wished_;
  QLabel* measured_;
  bool knows_rate_ = false;
  ros::Time last_;
  ros::WallTime last_wall_;
};

}  // namespace mocha
