#include "config/parameter_table.h"

#include <cmath>
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
bool parse(const YAML::Node& node, T& value) {
  try {
    value = node.as<T>();
    return true;
  } catch (const YAML::Exception&) {
    return false;
  }
}

bool is_quoted(const YAML::Node& node) { return node.Tag() == "!"; }

}  // namespace

ParameterTable ParameterTable::from_schema(const std::string& schema_path) {
  ParameterTable table;
  const YAML::Node schema = read_map(schema_path);
  for (const auto& item : schema) {
    const auto name = item.first.as<std::string>();
    table.entries_[name] = read_entry(item.second, schema_path + ": " + name);
  }
  return table;
}

ParameterTable::Entry ParameterTable::read_entry(const YAML::Node& node, const std::string& where) {
  for (const char* key : {"default", "unit", "about"}) {
    if (!node.IsMap() || !node[key]) throw ParameterError(where + ": has no `" + key + "`");
  }
  Entry entry;
  const YAML::Node value = node["default"];
  bool flag;
  int integer;
  double number;
  if (!is_quoted(value) && parse(value, flag)) {
    entry.type = Type::kFlag;
  } else if (!is_quoted(value) && parse(value, integer)) {
    entry.type = Type::kInteger;
  } else if (!is_quoted(value) && parse(value, number)) {
    entry.type = Type::kNumber;
  } else {
    entry.type = Type::kText;
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const bool has_range = node["min"] && node["max"];
  if ((entry.type == Type::kInteger || entry.type == Type::kNumber) && !has_range) {
    throw ParameterError(where + ": has no range (`min`, `max`)");
  }
  entry.min = has_range ? node["min"].as<double>() : -kInfinity;
  entry.max = has_range ? node["max"].as<double>() : kInfinity;
  entry.unit = node["unit"].as<std::string>();
  if (node["choices"]) entry.choices = node["choices"].as<std::vector<std::string>>();
  set_value(entry, value, where);
  return entry;
}

void ParameterTable::set_value(Entry& entry, const YAML::Node& value, const std::string& where) {
  if (!value.IsScalar()) throw ParameterError(where + ": is not a single value");
  const std::string text = value.Scalar();
  const auto refuse = [&](const std::string& expected) {
    throw ParameterError(where + " = " + text + ": expected " + expected);
  };
  if (entry.type == Type::kFlag && !parse(value, entry.flag)) refuse("true or false");
  if (entry.type == Type::kInteger) {
    int integer;
    if (!parse(value, integer)) refuse("an integer");
    entry.number = integer;
  }
  if (entry.type == Type::kNumber && !parse(value, entry.number)) refuse("a number");
  if (entry.type == Type::kInteger || entry.type == Type::kNumber) {
    if (!(entry.number >= entry.min && entry.number <= entry.max)) {
      std::ostringstream range;
      range << "a value from " << entry.min << " to " << entry.max << " (" << entry.unit << ")";
      refuse(range.str());
    }
  }
  if (!entry.choices.empty()) {
    std::string listed;
    bool known = false;
    for (const std::string& choice : entry.choices) {
      known = known || choice == text;
      listed += (listed.empty() ? "" : ", ") + choice;
    }
    if (!known) refuse("one of " + listed);
  }
  entry.value = text;
}

void ParameterTable::assign(const YAML::Node& values, const std::string& source) {
  for (const auto& item : values) {
    const auto name = item.first.as<std::string>();
    const auto entry = entries_.find(name);
    if (entry == entries_.end())
      throw ParameterError(source + ": unknown parameter `" + name + "`");
    set_value(entry->second, item.second, source + ": " + name);
  }
}

void ParameterTable::assign_file(const std::string& path) { assign(read_map(path), path); }

const ParameterTable::Entry& ParameterTable::find(const std::string& name, Type type) const {
  const auto entry = entries_.find(name);
  if (entry == entries_.end()) throw ParameterError("parameter `" + name + "` is not declared");
  if (entry->second.type != type) {
    throw ParameterError("parameter `" + name + "` is declared with another type");
  }
  return entry->second;
}

double ParameterTable::number(const std::string& name) const {
  return find(name, Type::kNumber).number;
}

int ParameterTable::integer(const std::string& name) const {
  return static_cast<int>(find(name, Type::kInteger).number);
}

bool ParameterTable::flag(const std::string& name) const { return find(name, Type::kFlag).flag; }

const std::string& ParameterTable::text(const std::string& name) const {
  return find(name, Type::kText).value;
}

std::vector<std::string> ParameterTable::names() const {
  std::vector<std::string> names;
  for (const auto& entry : entries_) names.push_back(entry.first);
  return names;
}

}  // namespace mocha
