#include "ros_bridge/runtime/raw_call.h"

#include <ros/network.h>

#include <cstdint>

namespace mocha {
namespace {

constexpr double kPatience_s = 2.0;
constexpr int kSuccess = 1;

}  // namespace

std::optional<XmlRpc::XmlRpcValue> raw_call(const std::string& uri, const char* method,
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

}  // namespace mocha
