#include "config/parameter_table.h"

#include <algorithm>
#include <limits>
#include <sstream>

namespace mocha {
namespace {

YAML::Node read_map(const std::string& path) {
  YAML::Node root;
  try {
    root = YAML::LoadFile(path);
  } catch (const YAML::BadFile&) {
    throw ParameterError(path + ": cannot be read");
  } catch (const YAML::Exception& error) {
    throw ParameterError(path + ": " + error.what());
  }
  if (!root.IsMap()) throw ParameterError(path + ": is not a map of names to values");
  return root;
}

template <typename T>
bool parse(const YAML::Node& node, ParameterValue& value) {
  try {
    value = node.as<T>();
    return true;
  } catch (const YAML::Exception&) {
    return false;
  }
}

ParameterValue default_of(const YAML::Node& node, const std::string& where) {
  if (!node.IsScalar()) throw ParameterError(where + ": is not a single value");
  ParameterValue value;
  const bool quoted = node.Tag() == "!";
  if (!quoted &&
      (parse<bool>(node, value) || parse<int>(node, value) || parse<double>(node, value)))
    return value;
  return node.Scalar();
}

const char* expected_type(const ParameterValue& value) {
  constexpr const char* kNames[] = {"true or false", "an integer", "a number", "a text"};
  return kNames[value.index()];
}

/// The node as a value of the type of `like`.
ParameterValue read_value(const YAML::Node& node, const ParameterValue& like,
                          const std::string& where) {
  if (!node.IsScalar()) throw ParameterError(where + ": is not a single value");
  ParameterValue value;
  const bool readable = std::visit(
      [&](const auto& typed) { return parse<std::decay_t<decltype(typed)>>(node, value); }, like);
  if (readable) return value;
  throw ParameterError(where + " = " + node.Scalar() + ": expected " + expected_type(like));
}

std::string to_text(const ParameterValue& value) {
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::digits10);
  text << std::boolalpha;
  std::visit([&](const auto& typed) { text << typed; }, value);
  return text.str();
}

std::string range_of(const Parameter& parameter) {
  std::ostringstream range;
  range << parameter.min << " to " << parameter.max << " (" << parameter.unit << ")";
  return range.str();
}

bool in_range(const Parameter& parameter, double value) {
  return value >= parameter.min && value <= parameter.max;
}

void check(const Parameter& parameter, const ParameterValue& value, const std::string& where) {
  const auto refuse = [&](const std::string& expected) {
    throw ParameterError(where + " = " + to_text(value) + ": expected " + expected);
  };
  const int* integer = std::get_if<int>(&value);
  const double* number = std::get_if<double>(&value);
  if ((integer && !in_range(parameter, *integer)) || (number && !in_range(parameter, *number)))
    refuse("a value from " + range_of(parameter));
  const auto& choices = parameter.choices;
  if (choices.empty() || std::count(choices.begin(), choices.end(), to_text(value)) > 0) return;
  std::string listed;
  for (const std::string& choice : choices) listed += (listed.empty() ? "" : ", ") + choice;
  refuse("one of " + listed);
}

/// Into the range; what is not a number stays what it is.
ParameterValue clamped(const Parameter& parameter, ParameterValue value) {
  if (int* integer = std::get_if<int>(&value))
    *integer = static_cast<int>(std::clamp<double>(*integer, parameter.min, parameter.max));
  if (double* number = std::get_if<double>(&value))
    *number = std::clamp(*number, parameter.min, parameter.max);
  return value;
}

Parameter read_declaration(const YAML::Node& node, const std::string& where) {
  for (const char* key : {"default", "unit", "about"}) {
    if (!node.IsMap() || !node[key]) throw ParameterError(where + ": has no `" + key + "`");
  }
  Parameter parameter;
  parameter.value = parameter.default_value = default_of(node["default"], where);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const bool has_range = node["min"] && node["max"];
  const bool is_number = std::holds_alternative<int>(parameter.value) ||
                         std::holds_alternative<double>(parameter.value);
  if (is_number && !has_range) throw ParameterError(where + ": has no range (`min`, `max`)");
  parameter.min = has_range ? node["min"].as<double>() : -kInfinity;
  parameter.max = has_range ? node["max"].as<double>() : kInfinity;
  parameter.unit = node["unit"].as<std::string>();
  parameter.about = node["about"].as<std::string>();
  if (node["choices"]) parameter.choices = node["choices"].as<std::vector<std::string>>();
  if (node["was"]) parameter.was = node["was"].as<std::string>();
  if (node["live"])
    parameter.live = std::get<bool>(read_value(node["live"], true, where + ".live"));
  check(parameter, parameter.value, where);
  return parameter;
}

}  // namespace

ParameterTable ParameterTable::from_schema(const std::string& schema_path) {
  ParameterTable table;
  const YAML::Node schema = read_map(schema_path);
  for (const auto& item : schema) {
    const auto name = item.first.as<std::string>();
    if (item.second.IsMap() && item.second["gone"])
      table.gone_[name] = item.second["gone"].as<std::string>();
    else
      table.parameters_[name] = read_declaration(item.second, schema_path + ": " + name);
  }
  return table;
}

Parameter& ParameterTable::find(std::map<std::string, Parameter>& parameters,
                                const std::string& name, const std::string& source) const {
  const auto found = parameters.find(name);
  if (found != parameters.end()) return found->second;
  const auto gone = gone_.find(name);
  if (gone != gone_.end())
    throw ParameterError(source + "parameter `" + name + "` is gone: " + gone->second);
  for (const auto& [now, parameter] : parameters) {
    if (parameter.was == name)
      throw ParameterError(source + "parameter `" + name + "` is called `" + now + "` now");
  }
  throw ParameterError(source + "unknown parameter `" + name + "`");
}

void ParameterTable::assign(const YAML::Node& values, const std::string& source) {
  auto parameters = parameters_;
  for (const auto& item : values) {
    const auto name = item.first.as<std::string>();
    const std::string where = source + ": " + name;
    Parameter& parameter = find(parameters, name, source + ": ");
    parameter.value = read_value(item.second, parameter.value, where);
    check(parameter, parameter.value, where);
  }
  parameters_ = std::move(parameters);
}

void ParameterTable::assign_file(const std::string& path) { assign(read_map(path), path); }

std::vector<std::string> ParameterTable::change(
    const std::vector<std::pair<std::string, ParameterValue>>& changes) {
  auto parameters = parameters_;
  std::vector<std::string> notes;
  for (const auto& [name, value] : changes) {
    Parameter& parameter = find(parameters, name, "");
    if (!parameter.live) throw ParameterError(name + ": is read at the start only");
    if (value.index() != parameter.value.index()) {
      throw ParameterError(name + " = " + to_text(value) + ": expected " +
                           expected_type(parameter.value));
    }
    parameter.value = clamped(parameter, value);
    check(parameter, parameter.value, name);
    if (parameter.value == value) continue;
    notes.push_back(name + " = " + to_text(value) + ": clamped to " + to_text(parameter.value) +
                    ", from " + range_of(parameter));
  }
  parameters_ = std::move(parameters);
  return notes;
}

template <typename T>
const T& ParameterTable::get(const std::string& name) const {
  const auto found = parameters_.find(name);
  if (found == parameters_.end()) throw ParameterError("parameter `" + name + "` is not declared");
  const T* value = std::get_if<T>(&found->second.value);
  if (!value) throw ParameterError("parameter `" + name + "` is declared with another type");
  return *value;
}

double ParameterTable::number(const std::string& name) const { return get<double>(name); }

int ParameterTable::integer(const std::string& name) const { return get<int>(name); }

bool ParameterTable::flag(const std::string& name) const { return get<bool>(name); }

const std::string& ParameterTable::text(const std::string& name) const {
  return get<std::string>(name);
}

}  // namespace mocha
