#include "ros_bridge/runtime/node_start.h"

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <exception>

#include "ros_bridge/runtime/name_holder.h"
#include "ros_bridge/runtime/robot_identity.h"
#include "ros_bridge/runtime/unavailable_error.h"

namespace mocha {
namespace {

const ros::WallDuration kReportPeriod(1.0);
const ros::WallDuration kRetry(5.0);

}  // namespace

NodeStart::NodeStart(int argc, char** argv, const std::string& program, std::uint32_t options,
                     Fault fault)
    : program_(program),
      remappings_(remappings_of(argc, argv)),
      name_(full_name(remappings_, program)),
      holder_(holder()),
      stays_(fault == Fault::kStays && remappings_.count("__log") > 0) {
  ros::M_string own = remappings_;
  if (!holder_.empty()) {
    own.erase("__name");
    options |= ros::init_options::AnonymousName;
  }
  ros::init(own, program, options);
}

std::string NodeStart::holder() const { return name_holder(remappings_, name_); }

int NodeStart::run(const std::function<void()>& make, const std::function<void()>& work,
                   const std::function<bool()>& is_ended) const {
  if (!holder_.empty()) {
    return refuse("another node with the name " + name_ + " runs at " + holder_ +
                      ": each robot needs a name of its own, and one stack",
                  [&] { return is_ended() || holder().empty(); });
  }
  try {
    make();
  } catch (const UnavailableError& error) {
    const ros::WallTime end = ros::WallTime::now() + kRetry;
    return refuse(error.what(), [&] { return is_ended() || ros::WallTime::now() > end; });
  } catch (const std::exception& error) {
    return refuse(error.what(), is_ended);
  }
  try {
    work();
  } catch (const std::exception& error) {
    ROS_FATAL("%s: %s", program_.c_str(), error.what());
    return 1;
  }
  return 0;
}

int NodeStart::refuse(const std::string& why, const std::function<bool()>& is_over) const {
  ROS_FATAL("%s: %s", program_.c_str(), why.c_str());
  if (!stays_) return 1;
  diagnostic_updater::Updater diagnostics(ros::NodeHandle(), ros::NodeHandle("~"), name_);
  diagnostics.setHardwareID(robot_identity().name);
  diagnostics.add("start", [&](diagnostic_updater::DiagnosticStatusWrapper& status) {
    status.summary(diagnostic_msgs::DiagnosticStatus::ERROR, "does not work: " + why);
  });
  while (ros::ok() && !is_over()) {
    diagnostics.force_update();
    ros::getGlobalCallbackQueue()->callAvailable(kReportPeriod);
  }
  return 1;
}

}  // namespace mocha
