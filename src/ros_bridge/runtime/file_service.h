#pragma once

#include <ros/console.h>

#include <exception>
#include <filesystem>
#include <string>

namespace mocha {

// Services that read or write files, and answer in `success` and `message`.

/// The whole path: relative ones count from where the node runs, which its user does not know.
inline std::string absolute(const std::string& path) {
  return path.empty() ? path : std::filesystem::absolute(path).lexically_normal().string();
}

/// `work` returns in words what was done, or throws why it was not.
template <class Response, class Work>
bool answer(Response& response, Work work) {
  try {
    response.message = work();
    response.success = true;
  } catch (const std::exception& error) {
    response.success = false;
    response.message = error.what();
    ROS_ERROR("%s", error.what());
  }
  return true;
}

}  // namespace mocha
