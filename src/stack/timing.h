#pragma once

#include <functional>
#include <string>
#include <vector>

#include "config/parameter_table.h"

namespace mocha {

/// How often perception publishes a map [s], though nothing changes.
constexpr double kMapPeriod_s = 0.5;

/// What parameters of one robot's nodes must keep to work together. Each is a time, or a rate that
/// stands for its period, and named with its node (of a schema in config/), or with "robot" for the
/// model: "local_replanner/lease".
struct TimingRule {
  enum class Relation { kLongerThan, kAtLeast };

  std::vector<std::string> left;  ///< summed up
  Relation relation;
  std::vector<std::string> right;  ///< summed up
  std::string why;                 ///< what happens else
  std::string where = "";          ///< a flag without which it does not matter; empty: none
};

const std::vector<TimingRule>& timing_rules();

/// The values of the node with that name, or of the "robot" model.
using ParameterSource = std::function<ParameterTable(const std::string&)>;

/// Throws ParameterError, naming all parameters of the first rule that is broken, of those that
/// involve `node`. Asks for the values that these need.
void check_timing(const std::string& node, const ParameterSource& values_of);

}  // namespace mocha
