#include "ros_bridge/inputs/battery_listener.h"

#include <utility>

#include "ros_bridge/runtime/transport.h"

namespace mocha {

BatteryListener::BatteryListener(ros::NodeHandle& node, const LowBattery::Options& options,
                                 Handlers handlers)
    : battery_(options),
      handlers_(std::move(handlers)),
      voltages_(node.subscribe<sensor_msgs::BatteryState>(
          "battery", 5, [this](const sensor_msgs::BatteryState::ConstPtr& state) {
            battery_.hear(ros::Time::now().toSec(), state->voltage);
          })) {}

void BatteryListener::step(ros::Time now, bool idle, bool stopped) {
  switch (battery_.step(now.toSec(), idle, stopped)) {
    case LowBattery::News::kNone:
      break;
    case LowBattery::News::kLow:
      ROS_WARN("%s", reason().c_str());
      handlers_.give_up(reason());
      break;
    case LowBattery::News::kGo:
      handlers_.take(battery_.goal());
      break;
    case LowBattery::News::kCharged:
      ROS_INFO("The battery is charged: goals are taken again");
      break;
  }
}

}  // namespace mocha
