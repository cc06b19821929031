#include "ros_bridge/inputs/refusals.h"

#include <ros/console.h>

namespace mocha {

void Refusals::add(const std::string& reason, const std::string& detail) {
  ++counts_[reason];
  ++total_;
  newest_ = detail.empty() ? reason : reason + " (" + detail + ")";
}

void Refusals::warn() {
  if (total_ == warned_of_) return;
  ROS_WARN_THROTTLE(10.0, "Refused: %s", newest_.c_str());
  warned_of_ = total_;
}

}  // namespace mocha
