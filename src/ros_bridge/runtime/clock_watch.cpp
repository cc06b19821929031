#include "ros_bridge/runtime/clock_watch.h"

namespace mocha {
namespace {

const ros::WallDuration kPeriod(5.0);

}  // namespace

ClockWatch::ClockWatch(const ros::NodeHandle& node)
    : timer_(node.createWallTimer(kPeriod, [this](const ros::WallTimerEvent&) { look(); })) {}

void ClockWatch::look() {
  if (!ros::Time::isSimTime() || !ros::Time::now().isZero()) return timer_.stop();
  ROS_WARN(
      "waits for /clock: /use_sim_time is true, and nobody publishes it. Without a simulation: "
      "rosparam set /use_sim_time false, and start again");
}

}  // namespace mocha
