#include "ros_bridge/runtime/step_loop.h"

#include <mocha_ugv/StepAck.h>

#include <utility>

#include "ros_bridge/runtime/transport.h"

namespace mocha {

StepLoop::StepLoop(ros::NodeHandle& node, const std::string& robot, double period_s,
                   std::function<void(ros::Time)> step)
    : robot_(robot), period_(period_s), step_(std::move(step)) {
  const std::string full_name = ros::this_node::getName();
  node_name_ = full_name.substr(full_name.rfind('/') + 1);
  if (ros::Time::isSimTime()) {
    acks_ = node.advertise<mocha_ugv::StepAck>("/fleet_simulator/acks", 50);
    clock_ = node.subscribe("/clock", 50, &StepLoop::on_clock, this, at_once());
  } else {
    timer_ =
        node.createSteadyTimer(ros::WallDuration(period_s),
                               [this](const ros::SteadyTimerEvent&) { step_(ros::Time::now()); });
  }
}

void StepLoop::on_clock(const rosgraph_msgs::Clock& clock) {
  const ros::Time now = clock.clock;
  if (now < last_) next_ = now;  // the clock was set back: a rosbag began again
  last_ = now;
  if (now >= next_) {
    step_(now);
    while (next_ <= now) next_ = next_.isZero() ? now + period_ : next_ + period_;
  }
  if (!held_) acknowledge();
}

void StepLoop::release() {
  if (!std::exchange(held_, false)) return;
  if (ros::Time::isSimTime()) acknowledge();
}

void StepLoop::acknowledge() {
  mocha_ugv::StepAck ack;
  ack.robot = robot_;
  ack.node = node_name_;
  ack.stamp = last_;
  acks_.publish(ack);
}

}  // namespace mocha
