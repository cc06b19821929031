#include "ros_bridge/runtime/memory_file.h"

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace mocha {

std::string memory_file(const std::string& parameter, const std::string& robot,
                        const std::string& extension) {
  if (!parameter.empty()) return parameter;
  const char* ros_home = std::getenv("ROS_HOME");
  const char* home = std::getenv("HOME");
  if (ros_home == nullptr && home == nullptr) {
    throw std::runtime_error("no file for " + robot + extension +
                             " is named, and there is neither ROS_HOME nor HOME");
  }
  const std::string folder = ros_home != nullptr ? ros_home : std::string(home) + "/.ros";
  return folder + "/mocha_ugv/" + robot + extension;
}

std::string beside(const std::string& file, const std::string& extension) {
  return std::filesystem::path(file).replace_extension(extension).string();
}

}  // namespace mocha
