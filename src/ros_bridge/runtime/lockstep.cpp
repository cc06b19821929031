#include "ros_bridge/runtime/lockstep.h"

#include <ros/callback_queue.h>
#include <rosgraph_msgs/Clock.h>

#include <algorithm>
#include <utility>

#include "ros_bridge/runtime/transport.h"

namespace mocha {
namespace {

constexpr std::uint32_t kQueue = 1000;
const ros::WallDuration kRepeat(0.1);      // of the start time, for nodes that are still starting
const ros::WallDuration kLongestNap(0.1);  // so that a shutdown is noticed

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

bool serve_until(ros::WallTime deadline, const std::function<bool()>& done) {
  ros::CallbackQueue& queue = *ros::getGlobalCallbackQueue();
  queue.callAvailable();
  while (ros::ok() && !done()) {
    const ros::WallDuration left = deadline - ros::WallTime::now();
    if (left <= ros::WallDuration(0.0)) return false;
    queue.callAvailable(std::min(left, kLongestNap));
  }
  return done();
}

Lockstep::Lockstep(ros::NodeHandle& node, AckRoster roster, ros::WallDuration start_timeout,
                   ros::WallDuration ack_timeout)
    : roster_(std::move(roster)),
      start_timeout_(start_timeout),
      ack_timeout_(ack_timeout),
      clock_(node.advertise<rosgraph_msgs::Clock>("/clock", kQueue)),
      acks_(node.subscribe("/fleet_simulator/acks", kQueue, &Lockstep::on_ack, this, at_once())) {}

void Lockstep::on_ack(const mocha_ugv::StepAck& ack) {
  roster_.acknowledge(ack.robot, ack.node, static_cast<std::int64_t>(ack.stamp.toNSec()));
}

void Lockstep::show(ros::Time now) {
  rosgraph_msgs::Clock clock;
  clock.clock = now;
  clock_.publish(clock);
}

bool Lockstep::serve_until_acknowledged(ros::Time stamp, ros::WallTime deadline) {
  const auto stamp_ns = static_cast<std::int64_t>(stamp.toNSec());
  return serve_until(deadline, [&] { return roster_.complete(stamp_ns); });
}

void Lockstep::await_nodes(ros::Time start) {
  const ros::WallTime deadline = ros::WallTime::now() + start_timeout_;
  bool complete = false;
  while (ros::ok() && !complete && ros::WallTime::now() < deadline) {
    show(start);
    complete = serve_until_acknowledged(start, ros::WallTime::now() + kRepeat);
  }
  if (complete || !ros::ok()) return;
  ROS_WARN("Starting without nodes that have not appeared within %.1f s: %s",
           start_timeout_.toSec(),
           listed(roster_.give_up(static_cast<std::int64_t>(start.toNSec()))).c_str());
}

void Lockstep::announce(ros::Time now) {
  show(now);
  if (serve_until_acknowledged(now, ros::WallTime::now() + ack_timeout_) || !ros::ok()) return;
  ROS_WARN("At %.3f s, no acknowledgement within %.1f s from %s: going on without", now.toSec(),
           ack_timeout_.toSec(),
           listed(roster_.give_up(static_cast<std::int64_t>(now.toNSec()))).c_str());
}

}  // namespace mocha
