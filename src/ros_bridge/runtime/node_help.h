#pragma once

#include <string>

#include "config/parameter_table.h"

namespace mocha {

/// How a node is started, and its parameters with unit, default, range and meaning.
std::string help_of(const std::string& node, const ParameterTable& parameters);

/// Whether a node is asked for its help alone (--help, -h), which is then printed: it needs no
/// master. To be called first of all.
bool prints_help(int argc, char** argv, const std::string& node);

}  // namespace mocha
