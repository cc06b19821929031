#include "ros_bridge/runtime/name_holder.h"

#include <ros/names.h>

#include <cstdlib>
#include <optional>

#include "ros_bridge/runtime/raw_call.h"

namespace mocha {
namespace {

std::string remapped_or(const ros::M_string& remappings, const char* key, const char* variable,
                        const std::string& otherwise) {
  const auto found = remappings.find(key);
  if (found != remappings.end()) return found->second;
  const char* value = variable == nullptr ? nullptr : std::getenv(variable);
  return value == nullptr || *value == '\0' ? otherwise : value;
}

}  // namespace

ros::M_string remappings_of(int argc, const char* const* argv) {
  ros::M_string remappings;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const std::size_t at = argument.find(":=");
    if (at != std::string::npos) remappings[argument.substr(0, at)] = argument.substr(at + 2);
  }
  return remappings;
}

std::string full_name(const ros::M_string& remappings, const std::string& program) {
  const std::string space = remapped_or(remappings, "__ns", "ROS_NAMESPACE", "");
  const std::string name = remapped_or(remappings, "__name", nullptr, program);
  return ros::names::clean("/" + space + "/" + name);
}

std::string name_holder(const ros::M_string& remappings, const std::string& name) {
  const std::string master = remapped_or(remappings, "__master", "ROS_MASTER_URI", "");
  XmlRpc::XmlRpcValue caller;
  caller[0] = name;
  XmlRpc::XmlRpcValue caller_and_node = caller;
  caller_and_node[1] = name;
  auto uri = raw_call(master, "lookupNode", caller_and_node);
  if (!uri || uri->getType() != XmlRpc::XmlRpcValue::TypeString) return "";
  return raw_call(*uri, "getPid", caller) ? static_cast<std::string>(*uri) : "";
}

}  // namespace mocha
