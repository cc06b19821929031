#include "ros_bridge/messages/parameter_conversions.h"

#include <limits>

namespace mocha {
namespace {

using dynamic_reconfigure::Config;

constexpr char kGroup[] = "Default";

/// A Python literal, since clients evaluate `edit_method`.
std::string quoted(const std::string& text) {
  std::string literal = "'";
  for (const char letter : text) {
    if (letter == '\'' || letter == '\\') literal += '\\';
    literal += letter;
  }
  return literal + "'";
}

std::string edit_method(const Parameter& parameter) {
  if (parameter.choices.empty()) return "";
  std::string constants;
  for (const std::string& choice : parameter.choices) {
    constants += (constants.empty() ? "" : ", ") + ("{'name': " + quoted(choice)) +
                 ", 'type': 'str', 'value': " + quoted(choice) + ", 'description': ''}";
  }
  return "{'enum': [" + constants + "], 'enum_description': " + quoted(parameter.about) + "}";
}

dynamic_reconfigure::ParamDescription describe(const std::string& name,
                                               const Parameter& parameter) {
  constexpr const char* kTypes[] = {"bool", "int", "double", "str"};
  dynamic_reconfigure::ParamDescription description;
  description.name = name;
  description.type = kTypes[parameter.value.index()];
  description.description =
      parameter.about + (parameter.unit == "-" ? "" : " [" + parameter.unit + "]");
  description.edit_method = edit_method(parameter);
  return description;
}

template <typename List, typename Value>
void append(List& list, const std::string& name, const Value& value) {
  auto& item = list.emplace_back();
  item.name = name;
  item.value = value;
}

void add(Config& config, const std::string& name, const ParameterValue& value) {
  if (const auto* flag = std::get_if<bool>(&value)) append(config.bools, name, *flag);
  if (const auto* integer = std::get_if<int>(&value)) append(config.ints, name, *integer);
  if (const auto* number = std::get_if<double>(&value)) append(config.doubles, name, *number);
  if (const auto* text = std::get_if<std::string>(&value)) append(config.strs, name, *text);
}

/// An end of the range, in the type of the value; flags and texts have ends by convention only.
ParameterValue bound(const Parameter& parameter, double end) {
  if (std::holds_alternative<bool>(parameter.value)) return end > 0.0;
  if (std::holds_alternative<int>(parameter.value)) return static_cast<int>(end);
  if (std::holds_alternative<double>(parameter.value)) return end;
  return std::string();
}

Config with_group() {
  Config config;
  auto& group = config.groups.emplace_back();
  group.name = kGroup;
  group.state = true;
  return config;
}

}  // namespace

dynamic_reconfigure::ConfigDescription to_description(const ParameterTable& table) {
  dynamic_reconfigure::ConfigDescription description;
  description.min = description.max = description.dflt = with_group();
  auto& group = description.groups.emplace_back();
  group.name = kGroup;
  for (const auto& [name, parameter] : table.parameters()) {
    if (!parameter.live) continue;
    group.parameters.push_back(describe(name, parameter));
    add(description.min, name, bound(parameter, parameter.min));
    add(description.max, name, bound(parameter, parameter.max));
    add(description.dflt, name, parameter.default_value);
  }
  return description;
}

Config to_config(const ParameterTable& table) {
  Config config = with_group();
  for (const auto& [name, parameter] : table.parameters()) {
    if (parameter.live) add(config, name, parameter.value);
  }
  return config;
}

std::vector<std::pair<std::string, ParameterValue>> from_message(const Config& config) {
  std::vector<std::pair<std::string, ParameterValue>> values;
  for (const auto& flag : config.bools) values.emplace_back(flag.name, flag.value != 0);
  for (const auto& integer : config.ints) values.emplace_back(integer.name, integer.value);
  for (const auto& number : config.doubles) values.emplace_back(number.name, number.value);
  for (const auto& text : config.strs) values.emplace_back(text.name, text.value);
  return values;
}

}  // namespace mocha
