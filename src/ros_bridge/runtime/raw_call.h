#pragma once

#include <xmlrpcpp/XmlRpc.h>

#include <optional>
#include <string>

namespace mocha {

/// The value that a method of ROS's master or node APIs returns; nothing where nobody answers soon,
/// or it fails. Needs nothing of ROS in this process: before its start and after its end, too.
std::optional<XmlRpc::XmlRpcValue> raw_call(const std::string& uri, const char* method,
                                            const XmlRpc::XmlRpcValue& arguments);

}  // namespace mocha
