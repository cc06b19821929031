#include "ros_bridge/runtime/node_help.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>
#include <string_view>

#include "ros_bridge/runtime/parameters.h"

namespace mocha {
namespace {

std::string text_of(const ParameterValue& value) {
  std::ostringstream text;
  text << std::boolalpha;
  std::visit([&](const auto& each) { text << each; }, value);
  return text.str().empty() ? "empty" : text.str();
}

std::string line_of(const std::string& name, const Parameter& parameter) {
  std::ostringstream line;
  line.precision(10);
  line << "  " << name << ": " << text_of(parameter.default_value);
  if (parameter.unit != "-") line << " " << parameter.unit;
  if (std::isfinite(parameter.min)) line << " (" << parameter.min << " to " << parameter.max << ")";
  for (std::size_t i = 0; i < parameter.choices.size(); ++i)
    line << (i == 0 ? " (" : ", ") << parameter.choices[i];
  if (!parameter.choices.empty()) line << ")";
  if (parameter.live) line << ", live";
  line << "\n      " << parameter.about << "\n";
  return line.str();
}

}  // namespace

std::string help_of(const std::string& node, const ParameterTable& parameters) {
  std::string text = "usage: rosrun mocha_ugv " + node +
                     " [_PARAMETER:=VALUE ...]\n\nIn the namespace of its robot "
                     "(ROS_NAMESPACE=ugv1). Parameters with their defaults and ranges; those that "
                     "are live change while it runs:\n\n";
  for (const auto& [name, parameter] : parameters.parameters()) text += line_of(name, parameter);
  return text;
}

bool prints_help(int argc, char** argv, const std::string& node) {
  const bool asks = std::any_of(argv, argv + argc, [](const char* argument) {
    return std::string_view(argument) == "--help" || std::string_view(argument) == "-h";
  });
  if (asks) std::cout << help_of(node, ParameterTable::from_schema(config_path(node + ".yaml")));
  return asks;
}

}  // namespace mocha
