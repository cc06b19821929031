#pragma once

#include <string>

namespace mocha {

/// Path of a file in which a robot remembers something over restarts: `parameter` or, where that is
/// empty, mocha_ugv/ROBOT with the extension in ROS_HOME or ~/.ros. Throws std::runtime_error where
/// there is neither.
std::string memory_file(const std::string& parameter, const std::string& robot,
                        const std::string& extension);

/// The path of another file beside it.
std::string beside(const std::string& file, const std::string& extension);

}  // namespace mocha
