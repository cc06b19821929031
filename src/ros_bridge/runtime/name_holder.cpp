#include "ros_bridge/runtime/name_holder.h"

#include <ros/names.h>
#include <ros/network.h>
#include <xmlrpcpp/XmlRpc.h>

#include <cstdint>
#include <cstdlib>
#include <optional>

namespace mocha {
namespace {

constexpr double kPatience_s = 2.0;
constexpr int kSuccess = 1;

std::string remapped_or(const ros::M_string& remappings, const char* key, const char* variable,
                        const std::string& otherwise) {
  const auto found = remappings.find(key);
  if (found != remappings.end()) return found->second;
  const char* value = variable == nullptr ? nullptr : std::getenv(variable);
  return value == nullptr || *value == '\0' ? otherwise : value;
}

/// The value that a method of ROS's master or node APIs returns; nothing where nobody answers, or
/// it fails.
std::optional<XmlRpc::XmlRpcValue> answer_of(const std::string& uri, const char* method,
                                             const XmlRpc::XmlRpcValue& arguments) {
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(uri, host, port)) return std::nullopt;
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  if (!client.executeNonBlock(method, arguments)) return std::nullopt;
  XmlRpc::XmlRpcDispatch dispatch;
  dispatch.addSource(&client,
                     XmlRpc::XmlRpcDispatch::WritableEvent | XmlRpc::XmlRpcDispatch::Exception);
  dispatch.work(kPatience_s);
  XmlRpc::XmlRpcValue answer;
  const bool done = client.executeCheckDone(answer);
  dispatch.removeSource(&client);
  using Value = XmlRpc::XmlRpcValue;
  if (!done || answer.getType() != Value::TypeArray || answer.size() != 3) return std::nullopt;
  if (answer[0].getType() != Value::TypeInt || static_cast<int>(answer[0]) != kSuccess)
    return std::nullopt;
  return answer[2];
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
  auto uri = answer_of(master, "lookupNode", caller_and_node);
  if (!uri || uri->getType() != XmlRpc::XmlRpcValue::TypeString) return "";
  return answer_of(*uri, "getPid", caller) ? static_cast<std::string>(*uri) : "";
}

}  // namespace mocha
