#include "rviz_panel/simulation_speed.h"

#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/param.h>
#include <ros/service.h>

#include <QHBoxLayout>
#include <utility>

namespace mocha {
namespace {

QString text_of(double rate) {
  return rate == 0.0 ? "as fast as possible" : QString("at most %1 times").arg(rate);
}

}  // namespace

SimulationSpeed::SimulationSpeed(BackgroundCalls& calls, std::function<void(std::string)> say,
                                 QWidget* parent)
    : QWidget(parent),
      calls_(calls),
      say_(std::move(say)),
      wished_(new QComboBox),
      measured_(new QLabel) {
  wished_->setObjectName("speed");
  for (const double rate : {0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 0.0})
    wished_->addItem(text_of(rate), rate);
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(new QLabel("Simulation:"));
  layout->addWidget(wished_);
  layout->addWidget(measured_, 1);
  connect(wished_, QOverload<int>::of(&QComboBox::activated), this,
          [this] { ask_for(wished_->currentData().toDouble()); });
}

void SimulationSpeed::measure() {
  setVisible(ros::Time::isSimTime());
  double rate = 1.0;
  if (!knows_rate_ && ros::param::get("/fleet_simulator/rate", rate)) {
    knows_rate_ = true;
    show_rate(rate);
  }
  const ros::Time now = ros::Time::now();
  const ros::WallTime wall = ros::WallTime::now();
  if (!last_.isZero() && now >= last_ && wall > last_wall_) {
    const double speed = (now - last_).toSec() / (wall - last_wall_).toSec();
    measured_->setText(QString("runs %1 times as fast as the clock").arg(speed, 0, 'f', 2));
  }
  last_ = now;
  last_wall_ = wall;
}

void SimulationSpeed::show_rate(double rate) {
  if (wished_->findData(rate) < 0) wished_->insertItem(0, text_of(rate), rate);
  wished_->setCurrentIndex(wished_->findData(rate));
}

void SimulationSpeed::ask_for(double rate) {
  calls_.add([say = say_, rate] {
    dynamic_reconfigure::Reconfigure call;
    call.request.config.doubles.resize(1);
    call.request.config.doubles[0].name = "rate";
    call.request.config.doubles[0].value = rate;
    if (!ros::service::call("/fleet_simulator/set_parameters", call)) {
      say("the simulator does not change its speed");
    }
  });
}

}  // namespace mocha
