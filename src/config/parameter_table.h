#pragma once

#include <yaml-cpp/yaml.h>

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace mocha {

/// A parameter is missing, misspelt, of the wrong type or out of range. what() names source, key,
/// value and range.
class ParameterError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Named values, each declared once in a schema file with unit, range and default.
///
/// Schema (YAML): `name: {default: 0.05, min: 0.01, max: 0.5, unit: m, about: Edge of a map
/// cell.}`. The type is that of the default: true/false, integer, number or text; text may list
/// `choices: [...]`. A default of `1.0` is a number, `1` an integer.
class ParameterTable {
 public:
  /// Reads a schema; every value is its default. Throws ParameterError naming file and key.
  static ParameterTable from_schema(const std::string& schema_path);

  /// Replaces values by those of a YAML map. Unknown keys, wrong types and values out of range
  /// throw ParameterError; `source` (a file or a ROS namespace) says in the error where they came
  /// from.
  void assign(const YAML::Node& values, const std::string& source);

  /// assign() with the contents of a YAML file.
  void assign_file(const std::string& path);

  double number(const std::string& name) const;
  int integer(const std::string& name) const;
  bool flag(const std::string& name) const;
  const std::string& text(const std::string& name) const;

  std::vector<std::string> names() const;

 private:
  enum class Type { kFlag, kInteger, kNumber, kText };
  struct Entry {
    Type type;
    std::string value;
    double number = 0.0;
    bool flag = false;
    double min;
    double max;
    std::string unit;
    std::vector<std::string> choices;
  };

  static Entry read_entry(const YAML::Node& node, const std::string& where);
  static void set_value(Entry& entry, const YAML::Node& value, const std::string& where);
  const Entry& find(const std::string& name, Type type) const;

  std::map<std::string, Entry> entries_;
};

}  // namespace mocha
