#include "ros_bridge/messages/parameter_conversions.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

namespace mocha {
namespace {

const char kSchema[] = R"(
cells: {default: 7, min: 1, max: 50, live: true, unit: "-", about: How many.}
fast: {default: true, live: true, unit: "-", about: Whether.}
hidden: {default: 1.0, min: 0.0, max: 2.0, unit: m, about: At the start only.}
kind: {default: "it's", choices: ["it's", 'a\b'], live: true, unit: "-", about: Which.}
speed: {default: 1.0, min: 0.5, max: 2.0, live: true, unit: m/s, about: How fast.}
)";

ParameterTable table() {
  const std::string path = ::testing::TempDir() + "parameter_conversions.yaml";
  std::ofstream(path) << kSchema;
  ParameterTable table = ParameterTable::from_schema(path);
  std::remove(path.c_str());
  return table;
}

void expect_config(const dynamic_reconfigure::Config& config, int cells, bool fast,
                   const std::string& kind, double speed) {
  ASSERT_EQ(config.ints.size(), 1u);
  EXPECT_EQ(config.ints[0].name, "cells");
  EXPECT_EQ(config.ints[0].value, cells);
  ASSERT_EQ(config.bools.size(), 1u);
  EXPECT_EQ(config.bools[0].name, "fast");
  EXPECT_EQ(config.bools[0].value, fast);
  ASSERT_EQ(config.strs.size(), 1u);
  EXPECT_EQ(config.strs[0].name, "kind");
  EXPECT_EQ(config.strs[0].value, kind);
  ASSERT_EQ(config.doubles.size(), 1u);
  EXPECT_EQ(config.doubles[0].name, "speed");
  EXPECT_EQ(config.doubles[0].value, speed);
  ASSERT_EQ(config.groups.size(), 1u);
  EXPECT_EQ(config.groups[0].name, "Default");
  EXPECT_TRUE(config.groups[0].state);
  EXPECT_EQ(config.groups[0].id, 0);
}

TEST(ParameterConversions, DescribeLiveParametersOnly) {
  ParameterTable parameters = table();
  parameters.change({{"speed", 1.5}});
  const auto description = to_description(parameters);
  expect_config(description.dflt, 7, true, "it's", 1.0);
  expect_config(description.min, 1, false, "", 0.5);
  expect_config(description.max, 50, true, "", 2.0);
  ASSERT_EQ(description.groups.size(), 1u);
  EXPECT_EQ(description.groups[0].name, "Default");
  const auto& listed = description.groups[0].parameters;
  ASSERT_EQ(listed.size(), 4u);
  const char* types[] = {"int", "bool", "str", "double"};
  for (int i = 0; i < 4; ++i) EXPECT_EQ(listed[i].type, types[i]) << listed[i].name;
  EXPECT_EQ(listed[0].description, "How many.");
  EXPECT_EQ(listed[3].description, "How fast. [m/s]");
  EXPECT_EQ(listed[3].edit_method, "");
}

TEST(ParameterConversions, OfferChoicesAsAPythonLiteral) {
  const auto description = to_description(table());
  EXPECT_EQ(description.groups[0].parameters[2].edit_method,
            R"({'enum': [{'name': 'it\'s', 'type': 'str', 'value': 'it\'s', 'description': ''}, )"
            R"({'name': 'a\\b', 'type': 'str', 'value': 'a\\b', 'description': ''}], )"
            R"('enum_description': 'Which.'})");
}

TEST(ParameterConversions, ValuesSurviveTheMessage) {
  ParameterTable parameters = table();
  parameters.change(
      {{"cells", 3}, {"fast", false}, {"kind", std::string("a\\b")}, {"speed", 0.75}});
  const auto config = to_config(parameters);
  expect_config(config, 3, false, "a\\b", 0.75);
  ParameterTable others = table();
  EXPECT_TRUE(others.change(from_message(config)).empty());
  expect_config(to_config(others), 3, false, "a\\b", 0.75);
}

}  // namespace
}  // namespace mocha
