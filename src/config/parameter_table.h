#pragma once

#include <yaml-cpp/yaml.h>

#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace mocha {

/// A parameter is missing, misspelt, of the wrong type or out of range. what() names source, key,
/// value and range.
class ParameterError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A flag, an integer, a number or a text; which of them never changes.
using ParameterValue = std::variant<bool, int, double, std::string>;

/// What a schema says about one parameter, and its value now.
struct Parameter {
  ParameterValue value;
  ParameterValue default_value;
  double min;  ///< of integers and numbers; -infinity where there is no range
  double max;
  std::string unit;  ///< "-" for none
  std::string about;
  std::vector<std::string> choices;  ///< of a text; empty: any
  bool live = false;                 ///< may change while the node runs
  std::string was;                   ///< its former name, which is refused; empty: none
};

/// Named values, each declared once in a schema file with unit, range and default.
///
/// Schema (YAML): `name: {default: 0.05, min: 0.01, max: 0.5, unit: m, about: Edge of a map
/// cell.}`. The type is that of the default: true/false, integer, number or text; text may list
/// `choices: [...]`. A default of `1.0` is a number, `1` an integer. `live: true` marks what may
/// change while the node runs. `was: edge` is a former name, which is refused with the new one.
/// `edge: {gone: follows from m}` is a parameter that is no more, and refused with that text.
class ParameterTable {
 public:
  /// Reads a schema; every value is its default. Throws ParameterError naming file and key.
  static ParameterTable from_schema(const std::string& schema_path);

  /// Replaces values by those of a YAML map: all of them or, where one is refused, none. Unknown
  /// keys, wrong types and values out of range throw ParameterError; `source` (a file or a ROS
  /// namespace) says in the error where they came from.
  void assign(const YAML::Node& values, const std::string& source);

  /// assign() with the contents of a YAML file.
  void assign_file(const std::string& path);

  /// Replaces values of live parameters: all of them or none. Integers and numbers out of range are
  /// clamped; returned is one line for each of these. Everything else that assign() refuses, a type
  /// that is not exactly the declared one and a parameter that is not live throw ParameterError.
  std::vector<std::string> change(
      const std::vector<std::pair<std::string, ParameterValue>>& changes);

  double number(const std::string& name) const;
  int integer(const std::string& name) const;
  bool flag(const std::string& name) const;
  const std::string& text(const std::string& name) const;

  const std::map<std::string, Parameter>& parameters() const { return parameters_; }

 private:
  template <typename T>
  const T& get(const std::string& name) const;

  Parameter& find(std::map<std::string, Parameter>& parameters, const std::string& name,
                  const std::string& source) const;

  std::map<std::string, Parameter> parameters_;
  std::map<std::string, std::string> gone_;  // by name: why
};

}  // namespace mocha
