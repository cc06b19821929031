#pragma once

#include <string>

namespace mocha {

/// config/ of the package that this module is a part of, in the devel or the install space.
std::string config_directory();

}  // namespace mocha
