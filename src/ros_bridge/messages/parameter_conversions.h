#pragma once

#include <dynamic_reconfigure/ConfigDescription.h>

#include <string>
#include <utility>
#include <vector>

#include "config/parameter_table.h"

namespace mocha {

/// Name, type, default, range and meaning of the live parameters, as clients of dynamic_reconfigure
/// expect them: all in the one group "Default".
dynamic_reconfigure::ConfigDescription to_description(const ParameterTable& table);

/// The values of the live parameters.
dynamic_reconfigure::Config to_config(const ParameterTable& table);

/// The values that a client asks for. Groups are nothing but a matter of display.
std::vector<std::pair<std::string, ParameterValue>> from_message(
    const dynamic_reconfigure::Config& config);

}  // namespace mocha
